// A grid of cells to draw: density, and freshness of the fire.
//
// Units: metres. Frame: world. Owns: nothing; the spans' data must be valid during the call only.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

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

}  // namespace dustbench::raycast
