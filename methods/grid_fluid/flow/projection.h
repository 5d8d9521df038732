// Makes the flow divergence-free: gathers ∇·u from each cell's faces and subtracts the gradient of the pressure from
// them.
//
// The faces are the state, so the stored flow is divergence-free to the solver's residual. Faces of solids, walls and
// inflows do not change. Units: the pressure is q = p·Δt/(ρ·h), in metres per second, so that h·∇·u = Σ w·(qₙ − q) and
// u −= h·∇q. Threads: rows in blocks. Source: Harlow1965 (staggered grid); Crane2007, 30.2.4 (solids).
#pragma once

#include <span>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/field_survey.h"
#include "methods/grid_fluid/flow/poisson_level.h"

namespace dustbench::grid_fluid::flow {

/// h·∇·u of each cell of fluid, 0 elsewhere.
void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest);

/// u −= h·∇q on all faces between cells of fluid, and between these and open sides.
/// Returns the survey of the new state.
FieldSurvey subtractGradient(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                             const PoissonLevel& finest);

/// The maximum |h·∇·u| over all cells of fluid.
[[nodiscard]] float maximumDivergence(const CellField& cells, const CellLayout& layout,
                                      const std::uint8_t* conductance);

}  // namespace dustbench::grid_fluid::flow
