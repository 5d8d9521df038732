#include "bench/suite/suite_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <numeric>
#include <set>

#include "bench/results/compared_runs.h"
#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_evaluation.h"
#include "methods/contract/errors.h"

namespace dustbench::suite {
namespace {

results::RunSpec baselineOf(results::RunSpec spec) {
    std::erase_if(spec.parameters, [](const auto& parameter) { return !isOfTheWorld(parameter.first); });
    spec.method = results::baselineMethod;
    spec.parameters = results::canonicalParameters(*results::findBaseline(), spec.parameters);
    spec.imagesEvery = 0;
    spec.volumes.reset();
    spec.metricPlan.reset();
    return spec;
}

/// The larger of two numbers of repetitions; 0 means all.
int moreOf(int a, int b) {
    return a == 0 || b == 0 ? 0 : std::max(a, b);
}

/// Disjoint sets of configurations (union-find); each set is identified by its first one.
class CellGroups {
 public:
    explicit CellGroups(std::size_t cells) : parents_(cells) { std::iota(parents_.begin(), parents_.end(), 0); }
    [[nodiscard]] std::size_t firstOf(std::size_t cell) const {
        while (parents_[cell] != cell) cell = parents_[cell];
        return cell;
    }
    void join(std::size_t a, std::size_t b) {
        const auto [first, later] = std::minmax({firstOf(a), firstOf(b)});
        parents_[later] = first;
    }

 private:
    std::vector<std::size_t> parents_;
};

}  // namespace

Suite withBaselines(Suite suite) {
    if (!suite.baseline || !results::findBaseline()) return suite;
    std::vector<Axis> axes = worldAxes(cellsOf(suite));
    std::erase_if(axes, [](const Axis& axis) { return axis.name == "scene"; });  // shown separately from the label
    std::map<std::string, std::size_t> added;                                    // by world
    std::vector<PlannedRun> baselines;
    for (const PlannedRun& cell : suite.cells) {
        if (cell.spec.method == results::baselineMethod || !cell.skip.empty()) continue;
        const auto [entry, isNew] = added.try_emplace(worldKey(cell.spec), baselines.size());
        if (isNew)
            baselines.push_back({baselineOf(cell.spec), labelOf(axes, cell.spec), cell.repetitions});
        else
            baselines[entry->second].repetitions = moreOf(baselines[entry->second].repetitions, cell.repetitions);
    }
    std::erase_if(baselines, [&](const PlannedRun& baseline) {
        return std::ranges::any_of(suite.cells, [&](const PlannedRun& cell) {
            return cell.spec.method == results::baselineMethod && cell.spec.parameters == baseline.spec.parameters &&
                   worldKey(cell.spec) == worldKey(baseline.spec);
        });
    });
    std::ranges::move(baselines, std::back_inserter(suite.cells));
    suite.baseline = false;
    return suite;
}

std::vector<std::size_t> groupCells(const Suite& suite) {
    CellGroups groups(suite.cells.size());
    std::map<std::string, std::size_t> firstOfWorld;
    for (std::size_t i = 0; i < suite.cells.size(); ++i)
        groups.join(i, firstOfWorld.emplace(worldKey(suite.cells[i].spec), i).first->second);
    for (const PlannedComparison& comparison : suite.comparisons)
        for (const CellPair& pair : matchCells(suite, comparison).pairs)
            groups.join(static_cast<std::size_t>(pair.of - suite.cells.data()),
                        static_cast<std::size_t>(pair.with - suite.cells.data()));
    std::vector<std::size_t> firsts;
    for (std::size_t i = 0; i < suite.cells.size(); ++i) firsts.push_back(groups.firstOf(i));
    return firsts;
}

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
            mine.insert(results::runId(inRepetition(cell.spec, repetition)));
    std::vector<PlannedRun> plan = planRuns(suite);
    std::erase_if(plan, [&mine](const PlannedRun& run) { return !mine.contains(results::runId(run.spec)); });
    return plan;
}

}  // namespace dustbench::suite
