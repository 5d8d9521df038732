// Plain projection, cell by cell: the reference for gatherDivergence and Projection.
//
//     h·∇·u = Σ ±u_f                   over the six faces: u_f = ½(u + uₙ), that of the neighbour where w = 0
//     u ← u − ½Σ ±w·(qₙ − q)           along each axis, over the two faces across it; u = ½Σ u_f beside one of w = 0
//
// w is the conductance of the neighbour (SolidCells). In double precision. Units: see projection.h.
// Source: Crane2007, 30.2.4 (solids); Almgren1996, 2 (cells take the mean of their faces).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// h·∇·u of all padded cells, 0 outside the fluid.
[[nodiscard]] std::vector<double> plainDivergence(const CellField& cells, const CellLayout& layout,
                                                  const std::uint8_t* conductance);

/// u − h·∇q of all padded cells, u outside the fluid; `q` of all padded cells.
[[nodiscard]] std::vector<glm::dvec3> plainProjection(const CellField& cells, const CellLayout& layout,
                                                      const std::uint8_t* conductance, const std::vector<double>& q);

}  // namespace dustbench::grid_fluid::flow
