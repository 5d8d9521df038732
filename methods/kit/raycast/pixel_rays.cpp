#include "methods/kit/raycast/pixel_rays.h"

#include <algorithm>
#include <cmath>

namespace dustbench::raycast {

PixelRays::PixelRays(const ShownGrid& grid, const scene::View& view) {
    const glm::dmat3 axes = glm::transpose(glm::dmat3(glm::mat3(view.worldToEye())));
    const double pixel = 2 * std::tan(view.camera.verticalFieldOfView / 2) / view.height;
    const glm::dvec3 x = pixel * axes[0], y = pixel * axes[1];
    // Subtract the eye in double precision, so that the grid may lie anywhere.
    eye = glm::vec3((view.camera.eye - grid.originMetres) / grid.spacingMetres);
    corner = glm::vec3(-axes[2] - 0.5 * view.width * x - 0.5 * view.height * y);
    right = glm::vec3(x);
    up = glm::vec3(y);
    nearDistance = static_cast<float>(view.camera.nearMetres / grid.spacingMetres);
}

PixelRectangle pixelsOf(const ShownGrid& grid, const glm::ivec3& minimum, const glm::ivec3& maximum,
                        const scene::View& view) {
    const PixelRectangle whole{0, 0, view.width, view.height};
    const glm::dmat3 toEye(glm::mat3(view.worldToEye()));
    const double scale = 0.5 * view.height / std::tan(view.camera.verticalFieldOfView / 2);
    glm::dvec2 lower(1e9), upper(-1e9);
    int before = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 cell(corner & 1 ? maximum.x : minimum.x, corner & 2 ? maximum.y : minimum.y,
                              corner & 4 ? maximum.z : minimum.z);
        const glm::dvec3 at = toEye * (grid.originMetres + grid.spacingMetres * cell - view.camera.eye);
        if (-at.z < 1e-3 * grid.spacingMetres) continue;
        ++before;
        const glm::dvec2 pixel = scale / -at.z * glm::dvec2(at) + 0.5 * glm::dvec2(view.width, view.height);
        lower = glm::min(lower, pixel);
        upper = glm::max(upper, pixel);
    }
    if (before == 0) return {};
    if (before < 8) return whole;
    // One more pixel on each side, for rounding.
    const auto within = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, double(size))); };
    return {within(std::floor(lower.x) - 1, view.width), within(std::floor(lower.y) - 1, view.height),
            within(std::ceil(upper.x) + 1, view.width), within(std::ceil(upper.y) + 1, view.height)};
}

}  // namespace dustbench::raycast
