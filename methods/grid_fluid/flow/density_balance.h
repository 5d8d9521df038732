// Conserves the total density of a cloud: semi-Lagrangian advection does not, and thin clouds gain most.
//
// Units: sums over cells of fluid. Threads: slabs independently, summed in order.
#pragma once

#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

[[nodiscard]] double densityTotal(const CellField& cells, const CellLayout& layout);
/// Density that leaves through open sides within a step, by the speeds of the faces there. `cellsPerSpeed` = Δt/h.
[[nodiscard]] double densityLeaving(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                                    float cellsPerSpeed);
/// Scales all densities so that they sum to `total`, by at most a tenth.
void scaleDensity(CellField& cells, const CellLayout& layout, double total);

}  // namespace dustbench::grid_fluid::flow
