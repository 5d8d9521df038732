#include "methods/kit/raycast/shown_grid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::raycast {
namespace {

constexpr int maximumCells = 2048;  // texels per axis of a 3D texture, guaranteed by OpenGL 4.5

void checkShown(const char* name, std::size_t got, std::size_t allowed) {
    if (got != allowed)
        throw InputError(std::string("shown grid: got ") + std::to_string(got) + " values of " + name +
                         ", allowed: " + std::to_string(allowed));
}

template <typename Grid>
void checkPlace(const Grid& grid) {
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.cells[axis] < 1 || grid.cells[axis] > maximumCells)
            throw InputError("shown grid: got " + std::to_string(grid.cells[axis]) +
                             " cells along an axis, allowed: 1.." + std::to_string(maximumCells));
        if (!std::isfinite(grid.originMetres[axis]))
            throw InputError("shown grid: got an origin that is not a number, allowed: a position in metres");
    }
    if (!(grid.spacingMetres > 0) || !std::isfinite(grid.spacingMetres))
        throw InputError("shown grid: got a spacing of " + std::to_string(grid.spacingMetres) +
                         " m, allowed: more than 0");
}

}  // namespace

void check(const ShownGrid& grid) {
    checkPlace(grid);
    checkShown("density", grid.density.size(), grid.cellCount());
    if (!grid.reaction.empty()) checkShown("reaction", grid.reaction.size(), grid.cellCount());
}

void check(const ShownTextures& grid) {
    checkPlace(grid);
    for (const gpu::Texture* texture : {grid.density, grid.reaction})
        if (texture && glm::ivec3(texture->width(), texture->height(), texture->depth()) != grid.cells)
            throw InputError("shown grid: got a texture of " + std::to_string(texture->width()) + "x" +
                             std::to_string(texture->height()) + "x" + std::to_string(texture->depth()) +
                             " texels, allowed: one for each cell");
}

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
