// Keeps the density of a cloud as a whole: no advection by look-up conserves it, and thin clouds gain most.
//
// Units: sums over cells of fluid. Threads: slabs by themselves, added up in order.
#pragma once

#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

[[nodiscard]] double densityTotal(const CellField& cells, const CellLayout& layout);
/// What flows out through open sides within a step, by the speeds of the outermost cells. `cellsPerSpeed` = Δt/h.
[[nodiscard]] double densityLeaving(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                                    float cellsPerSpeed);
/// Scales all densities so that they add up to `total`, by a tenth at most.
void scaleDensity(CellField& cells, const CellLayout& layout, double total);

}  // namespace dustbench::grid_fluid::flow
