// A grid of cells to draw: density, and freshness of the fire; and the rays through an image's pixels in its cells.
//
// Units: metres. Frame: world. Owns: nothing; the spans' data must be valid during the call only. Threads: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/view.h"

namespace dustbench::gpu {
class Texture;
}

namespace dustbench::raycast {

/// Cell averages, x fastest, no ghost cells.
struct ShownGrid {
    glm::ivec3 cells{0};
    double spacingMetres = 0;         ///< edge of a cell
    glm::dvec3 originMetres{0};       ///< minimum corner
    std::span<const float> density;   ///< 0 or more
    std::span<const float> reaction;  ///< 1 fresh fire … 0 burnt out; empty: smoke only

    [[nodiscard]] std::size_t cellCount() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
};

/// The same with values already on the GPU: R32F textures with one texel per cell and linear filtering. They must stay
/// valid and unchanged until another grid is shown.
struct ShownTextures {
    glm::ivec3 cells{0};
    double spacingMetres = 0;
    glm::dvec3 originMetres{0};
    const gpu::Texture* density = nullptr;
    const gpu::Texture* reaction = nullptr;  ///< null: smoke only
};

/// Throws InputError if the grid has no cells or spacing, or spans of a different size. Values are checked later, when
/// they are sorted into bricks.
void check(const ShownGrid& grid);
void check(const ShownTextures& grid);

// --- The pixels that see it, and their rays in cells from its minimum corner; pixels count from the bottom left

/// Pixels [left, right) × [bottom, top).
struct PixelRectangle {
    int left = 0, bottom = 0, right = 0, top = 0;
    [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
    [[nodiscard]] int width() const { return right - left; }
    [[nodiscard]] int height() const { return top - bottom; }
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(width()) * height(); }
    /// left bottom right top for an image of that size, each −1..1.
    [[nodiscard]] glm::vec4 inClipSpace(int pictureWidth, int pictureHeight) const {
        const glm::vec2 scale = 2.0f / glm::vec2(pictureWidth, pictureHeight);
        return glm::vec4(glm::vec2(left, bottom) * scale - 1.0f, glm::vec2(right, top) * scale - 1.0f);
    }
};

/// The ray at image coordinates (x, y) has direction corner + x·right + y·up, of length 1 along the camera's axis.
struct DUSTBENCH_API PixelRays {
    PixelRays(const ShownGrid& grid, const scene::View& view);

    glm::vec3 eye;
    glm::vec3 corner, right, up;
    float nearDistance;  ///< near distance; divided by the scene's depth it gives the distance along the camera's axis
};

/// All pixels that may see cells in [minimum, maximum).
[[nodiscard]] DUSTBENCH_API PixelRectangle pixelsOf(const ShownGrid& grid, const glm::ivec3& minimum,
                                                    const glm::ivec3& maximum, const scene::View& view);

/// Offset of a pixel's steps as a fraction of a step: the fractional part of x/g + y/g², where g is the plastic number.
/// Neighbouring pixels get distant offsets, and all offsets are equally frequent.
[[nodiscard]] inline float jitterOf(std::uint32_t x, std::uint32_t y) {
    return static_cast<float>((x * 3242174889u + y * 2447445414u) >> 8) * 0x1p-24f;
}

}  // namespace dustbench::raycast
