#include "bench/run/suite_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "bench/measure/statistics.h"
#include "methods/shared/stage_clock.h"

namespace dustbench::bench {
namespace {

struct Axis {
    std::string name;
    std::function<std::string(const RunSpec&)> of;
};

/// The method, and whatever else is not the same in all cells.
std::vector<Axis> varyingAxes(const Suite& suite) {
    std::vector<Axis> axes{
        {"scene", [](const RunSpec& spec) { return spec.scene; }},
        {"drive", [](const RunSpec& spec) { return spec.drive; }},
        {"size", [](const RunSpec& spec) { return fmt::format("{}x{}", spec.size.width, spec.size.height); }}};
    std::set<std::string> names;
    for (const PlannedRun& cell : suite.cells)
        for (const auto& [name, text] : cell.spec.parameters) names.insert(name);
    for (const std::string& name : names)
        axes.push_back({name, [name](const RunSpec& spec) {
                            const auto found = spec.parameters.find(name);
                            return found == spec.parameters.end() ? std::string() : found->second;
                        }});
    std::erase_if(axes, [&suite](const Axis& axis) {
        return std::ranges::all_of(suite.cells, [&](const PlannedRun& cell) {
            return axis.of(cell.spec) == axis.of(suite.cells.front().spec);
        });
    });
    axes.insert(axes.begin(), {"method", [](const RunSpec& spec) { return spec.method; }});
    return axes;
}

std::string fixed(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "";
}

/// A cell's runs that are done.
std::vector<const StoredRun*> doneRuns(const PlannedRun& cell, int repetitions,
                                       const std::map<std::string, StoredRun>& runs) {
    std::vector<const StoredRun*> done;
    for (int repetition = 1; repetition <= repetitions; ++repetition) {
        RunSpec spec = cell.spec;
        spec.repetition = repetition;
        const auto found = runs.find(runId(spec));
        if (found != runs.end() && found->second.status == RunStatus::done) done.push_back(&found->second);
    }
    return done;
}

std::vector<double> columnOf(const std::vector<const StoredRun*>& runs, const std::string& column) {
    std::vector<double> values;
    for (const StoredRun* run : runs)
        if (const auto found = run->cells.find(column); found != run->cells.end() && !found->second.empty())
            values.push_back(std::stod(found->second));
    return values;
}

}  // namespace

SuiteTable tabulate(const Suite& suite, const std::map<std::string, StoredRun>& runs) {
    SuiteTable table;
    if (suite.cells.empty()) return table;
    const std::vector<Axis> axes = varyingAxes(suite);
    for (const Axis& axis : axes) table.header.push_back(axis.name);
    for (const char* name : {"runs", "fps", "min", "max", "frame_ms", "p95_ms"}) table.header.emplace_back(name);
    for (const std::string_view stage : stageNames) table.header.push_back(std::string(stage) + "_ms");

    for (const PlannedRun& cell : suite.cells) {
        const auto done = doneRuns(cell, suite.repetitions, runs);
        const auto fps = columnOf(done, "fps_avg");
        std::vector<std::string> row;
        for (const Axis& axis : axes) row.push_back(axis.of(cell.spec));
        row.push_back(fmt::format("{}/{}", done.size(), suite.repetitions));
        for (const double value : {median(fps), quantile(fps, 0), quantile(fps, 1)}) row.push_back(fixed(value, 1));
        row.push_back(fixed(median(columnOf(done, "frame_ms_median")), 2));
        row.push_back(fixed(median(columnOf(done, "frame_ms_p95")), 2));
        for (const std::string_view stage : stageNames)
            row.push_back(fixed(median(columnOf(done, std::string(stage) + "_ms_median")), 2));
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace dustbench::bench
