// Makes the flow free of divergence: gathers ∇·u over each cell's faces, and takes off the gradient of the pressure.
//
// The speed of a face is the mean of its two cells', that of the solid where one is solid, the wind's at an inflow. It
// is the speeds of faces that balance exactly; a cell takes the mean of what its two faces change by, and beside a face
// that is blocked the mean of the speeds themselves. Units: the pressure is q = p·Δt/(ρ·h), in metres per second, so
// that h·∇·u = Σ w·(qₙ − q) and u −= h·∇q. Threads: rows in blocks. Source: Crane2007, 30.2.4 (solids); Almgren1996, 2
// (cells take the mean of their faces).
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
    /// What cells of fluid beside a face that conducts nothing will have.
    void findBesideBlocked(const CellField& cells, const CellLayout& layout, const SolidCells& solids,
                           const PoissonLevel& finest);

    std::vector<glm::vec3> besideBlocked_;
};

}  // namespace dustbench::grid_fluid::flow
