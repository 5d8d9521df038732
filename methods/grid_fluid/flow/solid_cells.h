// Which cells are solid, how fast their surface moves, and what that means for the faces between cells.
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

    /// Replaces all solids. The air that they leave has their speed, `cells` is told. Returns the density that they
    /// cover and that is lost so, summed over cells. Throws InputError where sizes do not fit, a velocity is not
    /// finite, or no fluid is left.
    double set(const SolidMask& mask, CellField& cells);

    /// For each padded cell what a face between it and a cell of fluid conducts: 1 fluid, 2 air beyond an open side,
    /// whose pressure is known half a cell away, 0 solids, walls and inflows.
    [[nodiscard]] const std::uint8_t* conductance() const { return conductance_.data(); }
    /// Cells of fluid beside a face that conducts nothing.
    [[nodiscard]] std::span<const std::uint32_t> besideBlocked() const { return besideBlocked_; }

    /// Gives the outermost cells of solids the mean of what flows beside them, so that a look-up near the surface does
    /// not mix in the inside; velocity too where the surface is without friction.
    void extendInto(CellField& cells, bool slip) const;
    /// Makes solid cells solid again: their own speed, nothing carried.
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
