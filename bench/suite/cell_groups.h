// Groups the configurations (cells) of a suite: all methods of one world, and worlds that a comparison links.
//
// The configurations of a group run on one machine, and consecutively within a round.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// For each configuration, the index of the first one of its group.
[[nodiscard]] std::vector<std::size_t> groupCells(const Suite& suite);

}  // namespace dustbench::bench
