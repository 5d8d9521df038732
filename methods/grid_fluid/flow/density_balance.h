// Conserves the total density of a cloud. Semi-Lagrangian advection does not; thin clouds gain most.
//
// Units: sums over cells of fluid. Threads: slabs independently, summed in order.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/solver.h"

namespace dustbench::grid_fluid::flow {

[[nodiscard]] double densityTotal(const CellField& cells, const CellLayout& layout);
/// Density that leaves through open sides within a step, by the speeds of the faces there. `cellsPerSpeed` = Δt/h.
/// `note`, unless null, receives it for each face.
[[nodiscard]] double densityLeaving(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                                    float cellsPerSpeed, std::vector<LeavingDensity>* note = nullptr);
/// Scales all densities so that they sum to `total`, by at most a tenth.
void scaleDensity(CellField& cells, const CellLayout& layout, double total);

}  // namespace dustbench::grid_fluid::flow
