// From the configurations (cells) of a suite to its runs: the baselines that are added, the groups that stay together,
// and the parts for several machines.
//
// Runs that are compared with each other form a group: they run on one machine, and consecutively within a round. A
// suite is split by assigning whole groups with all their repetitions: in order of size, largest first, each to the
// shard with the smallest number of runs. The split depends only on the suite; run ids do not depend on the split.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "bench/suite/suite.h"

namespace dustbench::suite {

/// The suite with one configuration of the null method, at its defaults and without pictures, appended to `cells` for
/// each world in which another method runs. It repeats as often as the world's most repeated configuration. Unchanged
/// if Suite::baseline is false, if a world already has such a configuration, or if this build has no null method.
[[nodiscard]] Suite withBaselines(Suite suite);

/// Groups the configurations: all methods of one world, and worlds that a comparison links. For each configuration, the
/// index of the first one of its group.
[[nodiscard]] std::vector<std::size_t> groupCells(const Suite& suite);

/// A part of a suite for one of several machines: `--shard 2/3`.
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

}  // namespace dustbench::suite
