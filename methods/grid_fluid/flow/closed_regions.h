// Finds closed regions of fluid, which have no outflow: their pressure is determined only up to a constant, and their
// net inflow cannot be removed.
//
// Threads: pure.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// Adjacent cells of fluid along x.
struct Run {
    int i, end, j, k;
};

/// The runs of each closed region, in the order of cells. Empty if all fluid is connected to an open side.
[[nodiscard]] std::vector<std::vector<Run>> closedRegions(const CellLayout& layout, const std::uint8_t* conductance);

}  // namespace dustbench::grid_fluid::flow
