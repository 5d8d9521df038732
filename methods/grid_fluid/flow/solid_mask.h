// Solids as given by a voxeliser, and the conductance of the box's faces; the same for every backend.
//
// Units: metres per second. Threads: pure.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"

namespace dustbench::grid_fluid::flow {

/// Motion of a solid relative to the grid: that of a rigid body, or one for each of its cells.
struct BodyMotion {
    glm::vec3 velocity{0};     ///< metres per second, at `centreCells`
    glm::vec3 turnPerCell{0};  ///< metres per second per cell of distance: angular velocity times spacing
    glm::vec3 centreCells{0};  ///< from the minimum corner of the box
    bool byCell = false;       ///< it deforms: SolidMask::velocities apply instead

    /// The velocity at a place in cells from the minimum corner of the box.
    [[nodiscard]] glm::vec3 velocityAt(const glm::vec3& place) const {
        return velocity + glm::cross(turnPerCell, place - centreCells);
    }
};

/// A number for each cell, x fastest, without ghosts.
struct SolidMask {
    std::span<const std::uint8_t> body;       ///< 0: fluid; n: the n-th solid; empty: fluid everywhere
    std::span<const BodyMotion> motions;      ///< of the solids, in order; solids beyond the last are at rest
    std::span<const glm::vec3> velocities{};  ///< of each cell in a deforming solid; empty: there is none

    /// Velocity of the solid with this number, above 0, in one of its cells.
    [[nodiscard]] glm::vec3 velocityOf(std::uint8_t solid, std::size_t cellIndex, const glm::ivec3& cell) const {
        const std::size_t n = solid - std::size_t{1};
        if (n >= motions.size()) return glm::vec3(0);
        return motions[n].byCell ? velocities[cellIndex] : motions[n].velocityAt(glm::vec3(cell) + 0.5f);
    }
};

/// Throws InputError if sizes do not match, a velocity is not finite, or no fluid remains.
void check(const SolidMask& mask, const CellLayout& layout);

/// The conductance of each padded cell if there are no solids (SolidCells::conductance).
void conductEverywhere(const CellLayout& layout, const Sides& sides, std::span<std::uint8_t> conductance);

}  // namespace dustbench::grid_fluid::flow
