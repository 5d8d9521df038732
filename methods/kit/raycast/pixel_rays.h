// The rays through a picture's pixels, in a grid's own cells, and which pixels may see a part of it.
//
// Units: cells; pixels from the bottom left. Frame: the grid's minimum corner. Threads: pure.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/view.h"
#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

/// Pixels [left, right) × [bottom, top).
struct PixelRectangle {
    int left = 0, bottom = 0, right = 0, top = 0;
    [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return top - bottom; }
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(width()) * height(); }
    /// left bottom right top of a picture of that size, each −1..1.
    [[nodiscard]] glm::vec4 inClipSpace(int pictureWidth, int pictureHeight) const {
        const glm::vec2 scale = 2.0f / glm::vec2(pictureWidth, pictureHeight);
        return glm::vec4(glm::vec2(left, bottom) * scale - 1.0f, glm::vec2(right, top) * scale - 1.0f);
    }
};

/// The ray at picture coordinates (x, y) runs along corner + x·right + y·up, of length 1 along the camera's axis.
struct PixelRays {
    PixelRays(const ShownGrid& grid, const scene::View& view);

    glm::vec3 eye;
    glm::vec3 corner, right, up;
    float nearDistance;  ///< what the scene's depth has to be divided into, as a distance along the camera's axis
};

/// All pixels that may see cells [minimum, most).
[[nodiscard]] PixelRectangle pixelsOf(const ShownGrid& grid, const glm::ivec3& minimum, const glm::ivec3& maximum,
                                      const scene::View& view);

/// The share of a step by which a pixel's steps are shifted: x·1/g + y·1/g², g the plastic number, without the whole
/// part. Pixels that are neighbours get shares far from each other, and all are used equally often.
[[nodiscard]] inline float jitterOf(std::uint32_t x, std::uint32_t y) {
    return static_cast<float>((x * 3242174889u + y * 2447445414u) >> 8) * 0x1p-24f;
}

}  // namespace dustbench::raycast
