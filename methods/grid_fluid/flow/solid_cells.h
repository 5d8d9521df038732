// The solid cells, the velocity of their surfaces, and the resulting conductance of faces between cells.
//
// Units: metres per second. Owns copies of what it is given. Threads: one writer.
// Source: Crane2007, 30.2.4. Departs: inside or outside by cell; the solid's speed is kept in its cells.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/solid_mask.h"

namespace dustbench::grid_fluid::flow {

class SolidCells {
 public:
    SolidCells(const CellLayout& layout, const Sides& sides, MemoryAccount& account);

    /// Replaces all solids. Uncovered air gets the solids' velocity, written to `cells`. Returns the density that is
    /// lost because solids cover it, summed over cells. Throws InputError if sizes do not fit, a velocity is not
    /// finite, or no fluid remains.
    double set(const SolidMask& mask, CellField& cells);

    /// For each padded cell, the conductance of a face between it and a fluid cell: 1 for fluid, 2 for air beyond an
    /// open side, whose pressure is known half a cell away, 0 for solids, walls and inflows.
    [[nodiscard]] const std::uint8_t* conductance() const { return conductance_.data(); }
    /// Cells of fluid beside a face that conducts nothing.
    [[nodiscard]] std::span<const std::uint32_t> besideBlocked() const { return besideBlocked_; }

    /// Sets the outermost solid cells to the mean of the adjacent fluid, so that samples near the surface do not mix in
    /// the inside; includes the velocity if the surface is frictionless.
    void extendInto(CellField& cells, bool slip) const;
    /// Restores solid cells: the solid's own velocity, no transported quantities.
    void restore(CellField& cells) const;

 private:
    /// A solid cell that touches fluid.
    struct Rim {
        std::uint32_t at;
        glm::vec3 velocity;
    };
    void findEdges(const CellField& cells);

    CellLayout layout_;
    LedgerVector<std::uint8_t> conductance_;
    std::vector<Rim> rim_;
    std::vector<std::uint32_t> besideBlocked_;
    std::vector<std::vector<std::uint32_t>> rimOfSlab_, besideOfSlab_;
};

}  // namespace dustbench::grid_fluid::flow
