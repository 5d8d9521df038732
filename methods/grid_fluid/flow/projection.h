// Makes the flow divergence-free: gathers ∇·u over each cell's faces and subtracts the gradient of the pressure.
//
// The speed of a face is the mean of its two cells', that of the solid if one is solid, or the wind's at an inflow.
// Only the face speeds balance exactly; a cell changes by the mean of the changes of its two faces, and beside a
// blocked face it takes the mean of the face speeds themselves. Units: the pressure is q = p·Δt/(ρ·h), in metres per
// second, so that h·∇·u = Σ w·(qₙ − q) and u −= h·∇q.
// Threads: rows in blocks.
// Source: Crane2007, 30.2.4 (solids); Almgren1996, 2 (cells take the mean of their faces).
#pragma once

#include <span>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/poisson_level.h"
#include "methods/grid_fluid/flow/solid_cells.h"

namespace dustbench::grid_fluid::flow {

/// h·∇·u of each cell of fluid, 0 elsewhere; `cells` with ghosts.
void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest);

class Projection {
 public:
    /// u −= h·∇q in all cells of fluid.
    void subtractGradient(CellField& cells, const CellLayout& layout, const SolidCells& solids,
                          const PoissonLevel& finest);

 private:
    /// Finds the new velocities of fluid cells beside a face that conducts nothing.
    void findBesideBlocked(const CellField& cells, const CellLayout& layout, const SolidCells& solids,
                           const PoissonLevel& finest);

    std::vector<glm::vec3> besideBlocked_;
};

}  // namespace dustbench::grid_fluid::flow
