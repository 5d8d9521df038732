#include "methods/kit/raycast/shown_grid.h"

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

}  // namespace dustbench::raycast
