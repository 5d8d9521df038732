#include "bench/suite/shard.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "bench/suite/baselines.h"
#include "bench/suite/cell_groups.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {

Shard parseShard(std::string_view text) {
    Shard shard{0, 0};
    const char* const end = text.data() + text.size();
    const auto [slash, indexError] = std::from_chars(text.data(), end, shard.index);
    if (indexError == std::errc() && slash != end && *slash == '/') {
        const auto [last, countError] = std::from_chars(slash + 1, end, shard.count);
        if (countError == std::errc() && last == end && shard.index >= 1 && shard.index <= shard.count &&
            shard.count <= maximumShards)
            return shard;
    }
    throw InputError(fmt::format("--shard: got '{}', allowed: I/N with 1 <= I <= N <= {}", text, maximumShards));
}

std::vector<int> shardOfCells(const Suite& suite, int count) {
    const std::vector<std::size_t> groups = groupCells(suite);
    std::map<std::size_t, std::size_t> sizes;  // by the first configuration of a group
    for (const std::size_t group : groups) ++sizes[group];
    std::vector<std::pair<std::size_t, std::size_t>> largestFirst(sizes.begin(), sizes.end());
    std::ranges::stable_sort(largestFirst, std::ranges::greater(), [](const auto& entry) { return entry.second; });

    std::set<std::pair<std::size_t, int>> loads;  // ordered by the number of configurations, then by shard number
    for (int shard = 1; shard <= count; ++shard) loads.emplace(0, shard);
    std::map<std::size_t, int> shardOfGroup;
    for (const auto& [first, size] : largestFirst) {
        const auto [load, shard] = *loads.begin();
        loads.erase(loads.begin());
        loads.emplace(load + size, shard);
        shardOfGroup[first] = shard;
    }
    std::vector<int> shards;
    shards.reserve(groups.size());
    for (const std::size_t group : groups) shards.push_back(shardOfGroup.at(group));
    return shards;
}

Suite partOf(const Suite& suite, Shard shard) {
    const std::vector<int> shards = shardOfCells(withBaselines(suite), shard.count);
    Suite part = suite;
    part.cells.clear();
    part.comparisons.clear();
    for (std::size_t i = 0; i < suite.cells.size(); ++i)
        if (shards[i] == shard.index) part.cells.push_back(suite.cells[i]);
    return part;
}

std::vector<PlannedRun> planRuns(const Suite& suite, Shard shard) {
    std::set<std::string> mine;
    for (const PlannedRun& cell : withBaselines(partOf(suite, shard)).cells)
        for (int repetition = 1; repetition <= suite.repetitions; ++repetition)
            mine.insert(runId(inRepetition(cell.spec, repetition)));
    std::vector<PlannedRun> plan = planRuns(suite);
    std::erase_if(plan, [&mine](const PlannedRun& run) { return !mine.contains(runId(run.spec)); });
    return plan;
}

}  // namespace dustbench::bench
