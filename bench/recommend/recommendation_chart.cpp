#include "bench/recommend/recommendation_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/report/chart_file.h"
#include "bench/report/run_groups.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

constexpr const char* groupId = "recommend";

/// A run that represents a setting in one world, from which the report finds the settings that vary.
StoredRun standIn(const Ranking& ranking, const MeasuredSetting& setting, std::size_t index) {
    StoredRun run;
    run.runId = fmt::format("{:06}", index);
    run.cells = {{"method", setting.method}};
    for (const SettingTexts* settings : {&ranking.world, &ranking.conduct})
        for (const auto& [name, value] : *settings) run.parameters[name] = value;
    for (const char* cell : {"scene", "drive", "sync", "threads", "frames"})
        if (const auto found = run.parameters.extract(cell)) run.cells.emplace(cell, found.mapped());
    if (const auto size = run.parameters.extract("size")) {
        const std::size_t x = size.mapped().find('x');
        run.cells.emplace("width", size.mapped().substr(0, x));
        run.cells.emplace("height", size.mapped().substr(x + 1));
    }
    run.parameters.insert(setting.own.begin(), setting.own.end());
    return run;
}

bool isDrawn(const MeasuredSetting& setting) {
    return std::isfinite(setting.quality.low) && std::isfinite(setting.quality.high);
}

struct Drawn {
    const Ranking* ranking;
    const MeasuredSetting* setting;
};

/// Adds a property in which rankings differ and which is not a setting of the world, as an axis of worlds.
void addWorldAxis(RunGroup& group, const std::string& name, const std::vector<std::string>& valueOfCell) {
    const std::set<std::string> values(valueOfCell.begin(), valueOfCell.end());
    if (values.size() < 2) return;
    ReportAxis axis;
    axis.name = name;
    axis.world = true;
    axis.values.assign(values.begin(), values.end());
    group.axes.push_back(std::move(axis));
    for (std::size_t cell = 0; cell < group.cells.size(); ++cell) group.cells[cell].settings[name] = valueOfCell[cell];
}

void fillCells(RunGroup& group, const std::vector<Drawn>& drawn, const Metric& quality) {
    std::vector<std::string> references, machines, lengths;
    for (ReportCell& cell : group.cells) {
        const auto& [ranking, setting] = drawn[std::stoul(cell.done.front()->runId)];
        cell.values = {{std::string(timeColumn), setting->ms}, {std::string(quality.column), setting->quality}};
        // The report only draws charts of quality for runs with this column.
        if (const auto flip = setting->metrics.find("flip"); flip != setting->metrics.end()) cell.values.insert(*flip);
        references.push_back(ranking->reference);
        machines.push_back(fmt::format("{}", ranking->machine + 1));
        lengths.push_back(ranking->evaluatedFrames);
    }
    addWorldAxis(group, "reference", references);
    addWorldAxis(group, "machine", machines);
    addWorldAxis(group, "compared frames", lengths);
}

}  // namespace

std::size_t drawRecommendation(const Rankings& rankings, const MeasuredRuns& runs, const Budget& budget,
                               const std::filesystem::path& file, const std::string& what) {
    std::vector<Drawn> drawn;
    ReportData data;
    std::size_t leftOut = 0;
    for (const Ranking& ranking : rankings.rankings)
        for (const MeasuredSetting& setting : ranking.settings) {
            leftOut += isDrawn(setting) ? 0 : 1;
            if (!isDrawn(setting)) continue;
            StoredRun run = standIn(ranking, setting, drawn.size());
            data.runs.emplace(run.runId, std::move(run));
            drawn.push_back({&ranking, &setting});
        }
    if (drawn.empty()) throw InputError(what + ": no setting has both a time and a quality that a chart can show");
    std::vector<const StoredRun*> standIns;
    MachineOfRun machineOfRun;
    for (const auto& [id, run] : data.runs) {
        standIns.push_back(&run);
        machineOfRun[id] = drawn[std::stoul(id)].ranking->machine;
    }
    RunGroup group = makeGroup(standIns, machineOfRun);
    group.id = groupId;
    group.chart.column = rankings.quality.column;
    group.budgetMs = budget.ms;
    fillCells(group, drawn, rankings.quality);
    data.groups.push_back(std::move(group));
    for (const MachineFacts& machine : runs.machines) data.machines.push_back(machine.fields);
    drawChart(data, std::string(groupId) + "-quality", file, what);
    return leftOut;
}

}  // namespace dustbench::bench
