// Splits a suite into parts for several machines: `--shard 2/3`.
//
// Runs that are compared with each other must run on one machine, so whole groups of configurations (cell_groups.h) are
// assigned with all their repetitions: in order of size, largest first, each to the shard with the smallest number of
// runs. The split depends only on the suite; run ids do not depend on the split.
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

/// The shard of every configuration, from 1.
[[nodiscard]] std::vector<int> shardOfCells(const Suite& suite, int count);

/// The suite with only the shard's configurations, without verdicts, which need the whole suite.
[[nodiscard]] Suite partOf(const Suite& suite, Shard shard);

/// The shard's runs, in the order of the whole suite's plan.
[[nodiscard]] std::vector<PlannedRun> planRuns(const Suite& suite, Shard shard);

}  // namespace dustbench::bench
