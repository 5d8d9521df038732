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

#include "methods/shared/fluid/cell_field.h"
#include "methods/shared/fluid/poisson_level.h"
#include "methods/shared/fluid/solid_cells.h"

namespace dustbench::fluid {

/// h·∇·u of each cell of fluid, 0 elsewhere; `cells` with ghosts.
void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest);

/// The speed of the face between a cell of fluid and the next one towards `step` (in padded cells), before projection.
[[nodiscard]] float faceSpeed(const CellField& cells, const std::uint8_t* conductance, std::size_t at,
                              std::ptrdiff_t step, std::size_t axis);

class Projection {
 public:
    /// u −= h·∇q in all cells of fluid.
    void subtractGradient(CellField& cells, const CellLayout& layout, const SolidCells& solids,
                          const PoissonLevel& finest);

 private:
    std::vector<glm::vec3> besideBlocked_;
};

}  // namespace dustbench::fluid
