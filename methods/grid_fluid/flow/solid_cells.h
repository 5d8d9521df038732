// The solid cells, the speeds of their faces, the moving parts of all cells, and the conductance between cells.
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
#include "methods/grid_fluid/flow/solid_mask.h"

namespace dustbench::grid_fluid::flow {

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
