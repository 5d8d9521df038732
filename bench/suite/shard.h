// Splits a suite into parts for several machines: `--shard 2/3`.
//
// Runs that are compared with each other must run on one machine, so groups of cells (cell_groups.h) are distributed
// with all their repetitions. The largest group goes first, each to the shard with the fewest runs. The split depends
// only on the suite; run ids do not depend on it.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::bench {

struct Shard {
    int index = 1;  ///< from 1
    int count = 1;
};
/// `2/3`. Throws InputError.
[[nodiscard]] Shard parseShard(std::string_view text);

inline constexpr int maximumShards = 10'000;

/// The shard of every cell, from 1.
[[nodiscard]] std::vector<int> shardOfCells(const Suite& suite, int count);

/// The suite with only the shard's cells. Verdicts are omitted: they need the whole suite.
[[nodiscard]] Suite partOf(const Suite& suite, Shard shard);

/// The shard's runs, in the order of the whole suite's plan.
[[nodiscard]] std::vector<PlannedRun> planRuns(const Suite& suite, Shard shard);

}  // namespace dustbench::bench
