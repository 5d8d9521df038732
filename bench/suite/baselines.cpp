#include "bench/suite/baselines.h"

#include <algorithm>
#include <map>

#include "bench/results/compared_runs.h"
#include "bench/suite/suite_axes.h"

namespace dustbench::bench {
namespace {

RunSpec baselineOf(RunSpec spec) {
    std::erase_if(spec.parameters, [](const auto& parameter) { return !isOfTheWorld(parameter.first); });
    spec.method = baselineMethod;
    spec.parameters = canonicalParameters(*findBaseline(), spec.parameters);
    spec.imagesEvery = 0;
    spec.volumes.reset();
    spec.metricPlan.reset();
    return spec;
}

/// The larger of two numbers of repetitions; 0 means all.
int moreOf(int a, int b) {
    return a == 0 || b == 0 ? 0 : std::max(a, b);
}

}  // namespace

Suite withBaselines(Suite suite) {
    if (!suite.baseline || !findBaseline()) return suite;
    std::vector<Axis> axes = worldAxes(cellsOf(suite));
    std::erase_if(axes, [](const Axis& axis) { return axis.name == "scene"; });  // shown separately from the label
    std::map<std::string, std::size_t> added;                                    // by world
    std::vector<PlannedRun> baselines;
    for (const PlannedRun& cell : suite.cells) {
        if (cell.spec.method == baselineMethod || !cell.skip.empty()) continue;
        const auto [entry, isNew] = added.try_emplace(worldKey(cell.spec), baselines.size());
        if (isNew)
            baselines.push_back({baselineOf(cell.spec), labelOf(axes, cell.spec), cell.repetitions});
        else
            baselines[entry->second].repetitions = moreOf(baselines[entry->second].repetitions, cell.repetitions);
    }
    std::erase_if(baselines, [&](const PlannedRun& baseline) {
        return std::ranges::any_of(suite.cells, [&](const PlannedRun& cell) {
            return cell.spec.method == baselineMethod && cell.spec.parameters == baseline.spec.parameters &&
                   worldKey(cell.spec) == worldKey(baseline.spec);
        });
    });
    std::ranges::move(baselines, std::back_inserter(suite.cells));
    suite.baseline = false;
    return suite;
}

}  // namespace dustbench::bench
