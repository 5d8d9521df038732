// Solids as a voxeliser gives them, and what the faces of a box conduct; the same for every backend.
//
// Units: metres per second. Threads: pure.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"

namespace dustbench::grid_fluid::flow {

/// How a solid moves, as it is seen from the grid.
struct BodyMotion {
    glm::vec3 velocity{0};     ///< metres per second, at `centreCells`
    glm::vec3 turnPerCell{0};  ///< metres per second for each cell of distance: angular velocity times spacing
    glm::vec3 centreCells{0};  ///< from the minimum corner of the box

    [[nodiscard]] glm::vec3 velocityAt(int i, int j, int k) const {
        return velocity + glm::cross(turnPerCell, glm::vec3(i, j, k) + 0.5f - centreCells);
    }
};

/// A number for each cell, x fastest, without ghosts.
struct SolidMask {
    std::span<const std::uint8_t> body;   ///< 0: fluid; n: the n-th solid; empty: fluid everywhere
    std::span<const BodyMotion> motions;  ///< of the solids, from the first on; those beyond the last are at rest
};

/// Throws InputError where sizes do not fit, a velocity is not finite, or no fluid is left.
void check(const SolidMask& mask, const CellLayout& layout);

/// What each padded cell conducts where there are no solids (SolidCells::conductance).
void conductEverywhere(const CellLayout& layout, const Sides& sides, std::span<std::uint8_t> conductance);

}  // namespace dustbench::grid_fluid::flow
