// Plain projection, face by face; the reference implementation of gatherDivergence and subtractGradient.
//
//     h·∇·u = Σ ±u_f           over the six faces of a cell of fluid
//     u_f ← u_f − w·(q − q₋)    w is 0 at a solid, wall or inflow, 1 in fluid, 2 at an open side, where q is 0
//
// In double precision. Units: see projection.h. Source: Harlow1965 (staggered grid); Crane2007, 30.2.4 (solids).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// h·∇·u of all padded cells, 0 outside the fluid.
[[nodiscard]] std::vector<double> plainDivergence(const CellField& cells, const CellLayout& layout,
                                                  const std::uint8_t* conductance);

/// u − h·∇q on the faces towards −x, −y, −z of all padded cells; `q` of all padded cells.
[[nodiscard]] std::vector<glm::dvec3> plainProjection(const CellField& cells, const CellLayout& layout,
                                                      const std::uint8_t* conductance, const std::vector<double>& q);

}  // namespace dustbench::grid_fluid::flow
