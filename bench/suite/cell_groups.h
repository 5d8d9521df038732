// Which cells of a suite belong together: all methods of one world, and the worlds that a comparison brings together.
//
// Such cells run on one machine, and within a round one after the other.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// For each cell, the number of the first cell of its group.
[[nodiscard]] std::vector<std::size_t> groupCells(const Suite& suite);

}  // namespace dustbench::bench
