// Solids as given by a voxeliser, and on the CPU: the solid cells, the speeds of their faces, the moving parts of all
// cells, and the conductance between cells.
//
// Units: metres per second. Owns copies of its inputs. Threads: one writer.
// Source: Crane2007, 30.2.4. Departs: each cell is inside or outside; a solid's speed is stored on the faces of its
// cells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/advection.h"
#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"

namespace dustbench::grid_fluid::flow {

// --- The same for every backend

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

// --- On the CPU

class SolidCells {
 public:
    SolidCells(const CellLayout& layout, const Sides& sides, MemoryAccount& account);

    /// Changes that new solids make to the state.
    struct Change {
        double coveredDensity = 0;   ///< lost because solids cover it, summed over cells
        glm::vec3 maximumSpeeds{0};  ///< of the solids' faces across x, y and z
    };
    /// Replaces all solids. Faces of solids get their speeds, and faces of uncovered air keep them; both are written to
    /// `cells`. Throws InputError if sizes do not match, a velocity is not finite, or no fluid remains.
    Change set(const SolidMask& mask, CellField& cells);

    /// For each padded cell, the conductance of a face between it and a fluid cell: 1 for fluid, 2 for air beyond an
    /// open side, whose pressure is known half a cell away, 0 for solids, walls and inflows.
    [[nodiscard]] const std::uint8_t* conductance() const { return conductance_.data(); }
    /// For each padded cell: faces between two cells of fluid, and cells of fluid.
    [[nodiscard]] const Moving* moving() const { return moving_.data(); }

    /// Sets the rim inside the solids to the mean of adjacent moving values, so that samples near the surface do not
    /// mix in the inside: at centres, and on faces between two solid cells if the surface is frictionless.
    void extendInto(CellField& cells, bool slip) const;
    /// Restores the rim: the solid's own speed on faces, 0 at centres.
    void restore(CellField& cells) const;

 private:
    /// A value inside a solid next to one that moves.
    struct Rim {
        std::uint32_t at;
        std::uint8_t lane;  ///< that of a velocity, or `density` for all quantities at the centre
        float solid;        ///< the solid's own speed
    };
    double cover(const SolidMask& mask, CellField& cells);
    [[nodiscard]] glm::vec3 setFaces(const SolidMask& mask, CellField& cells) const;
    void findMoving();
    void findRim(const CellField& cells);

    /// Whether it is a row of the box without solids.
    [[nodiscard]] bool isAllFluid(int j, int k) const {
        return j >= 0 && k >= 0 &&
               !rowHasSolid_[static_cast<std::size_t>(k) * static_cast<std::size_t>(layout_.ny) +
                             static_cast<std::size_t>(j)];
    }

    CellLayout layout_;
    LedgerVector<std::uint8_t> conductance_, moving_;
    std::vector<std::uint8_t> rowHasSolid_;
    std::vector<Rim> rim_;
    std::vector<std::vector<Rim>> rimOfSlab_;
};

}  // namespace dustbench::grid_fluid::flow
