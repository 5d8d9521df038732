// A grid of cells to be shown: how much there is in each, and how fresh its fire is.
//
// Units: metres. Frame: world. Owns nothing: what the spans look at must last for the call alone.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace dustbench::gpu {
class Texture;
}

namespace dustbench::raycast {

/// Cell averages, x fastest, no ghosts.
struct ShownGrid {
    glm::ivec3 cells{0};
    double spacingMetres = 0;         ///< edge of a cell
    glm::dvec3 originMetres{0};       ///< minimum corner
    std::span<const float> density;   ///< 0 or more
    std::span<const float> reaction;  ///< 1 fresh fire … 0 burnt out; empty: smoke alone

    [[nodiscard]] std::size_t cellCount() const {
        return static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
               static_cast<std::size_t>(cells.z);
    }
};

/// The same with its values on the GPU already: R32F textures of one texel for each cell, looked up linearly. They must
/// last, unchanged, until another grid is shown.
struct ShownTextures {
    glm::ivec3 cells{0};
    double spacingMetres = 0;
    glm::dvec3 originMetres{0};
    const gpu::Texture* density = nullptr;
    const gpu::Texture* reaction = nullptr;  ///< null: smoke alone
};

/// Throws InputError for a grid without cells or spacing, or with spans of another size. Values are looked at when they
/// are sorted into bricks.
void check(const ShownGrid& grid);
void check(const ShownTextures& grid);

}  // namespace dustbench::raycast
