// Finds regions of fluid from which nothing can flow out: their pressure is known but for a constant, and their net
// inflow cannot be made to vanish.
//
// Threads: pure.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/grid_fluid/flow/cell_field.h"

namespace dustbench::grid_fluid::flow {

/// Cells of fluid side by side along x.
struct Run {
    int i, end, j, k;
};

/// The runs of each closed region, in the order of cells. Empty: all fluid is connected to an open side.
[[nodiscard]] std::vector<std::vector<Run>> closedRegions(const CellLayout& layout, const std::uint8_t* conductance);

}  // namespace dustbench::grid_fluid::flow
