#include "bench/recommend/recommendation_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/report/chart_file.h"
#include "bench/report/run_groups.h"
#include "methods/contract/errors.h"

namespace dustbench::recommend {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json intervalJson(const report::MedianInterval& interval) {
    return {{"median", number(interval.median)},
            {"low", number(interval.low)},
            {"high", number(interval.high)},
            {"values", interval.values},
            {"probability", number(interval.probability)}};
}

ordered_json settingJson(const MeasuredSetting& setting, double budgetMs) {
    ordered_json metrics = ordered_json::object();
    for (const auto& [column, interval] : setting.metrics) metrics[column] = intervalJson(interval);
    return {{"label", setting.label},
            {"method", setting.method},
            {"parameters", setting.own},
            {"fits", fits(setting, budgetMs)},
            {"on_front", setting.onFront},
            {"timed_seeds", setting.timedSeeds},
            {"judged_in_other_runs", setting.otherRuns},
            {timeColumn, intervalJson(setting.ms)},
            {"metrics", std::move(metrics)}};
}

ordered_json rankingJson(const Ranking& ranking, const Recommendation& answer, double budgetMs) {
    ordered_json settings = ordered_json::array();
    for (const MeasuredSetting& setting : ranking.settings) settings.push_back(settingJson(setting, budgetMs));
    return {{"label", ranking.label},
            {"world", ranking.world},
            {"timed", ranking.conduct},
            {"judged_frames", ranking.evaluatedFrames},
            {"reference", ranking.reference},
            {"machine", ranking.machine},
            {"recommended", answer.recommended ? ordered_json(*answer.recommended) : ordered_json(nullptr)},
            {"equally_good", answer.equallyGood},
            {"cheapest", answer.cheapest},
            {"settings", std::move(settings)}};
}

}  // namespace

std::string recommendationJson(const Budget& budget, const MeasuredRuns& runs, const Rankings& rankings,
                               const std::vector<Recommendation>& recommendations) {
    ordered_json machines = ordered_json::array(), worlds = ordered_json::array(), incomplete = ordered_json::array();
    for (const MachineFacts& machine : runs.machines)
        machines.push_back({{"fields", machine.fields}, {"commits", machine.commits}});
    for (std::size_t index = 0; index < rankings.rankings.size(); ++index)
        worlds.push_back(rankingJson(rankings.rankings[index], recommendations[index], budget.ms));
    for (const Incomplete& setting : rankings.incomplete)
        incomplete.push_back({{"label", setting.label},
                              {"world", setting.world},
                              {"has_time", setting.hasTime},
                              {"has_quality", setting.hasQuality}});
    const ordered_json root{
        {"budget_ms", budget.ms},          {"asked", budget.asked},       {"quality", rankings.quality.column},
        {"machines", std::move(machines)}, {"not_done", runs.notDone},    {"invalid", runs.invalid},
        {"why_invalid", runs.whyInvalid},  {"worlds", std::move(worlds)}, {"incomplete", std::move(incomplete)}};
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

namespace {

constexpr const char* groupId = "recommend";

/// A run that represents a setting in one world, from which the report finds the settings that vary.
results::StoredRun standIn(const Ranking& ranking, const MeasuredSetting& setting, std::size_t index) {
    results::StoredRun run;
    run.runId = fmt::format("{:06}", index);
    run.cells = {{"method", setting.method}};
    for (const SettingTexts* settings : {&ranking.world, &ranking.conduct})
        for (const auto& [name, value] : *settings) run.parameters[name] = value;
    for (const char* cell : {"scene", "drive", "sync", "threads", "frames", "dust_on"})
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
void addWorldAxis(report::RunGroup& group, const std::string& name, const std::vector<std::string>& valueOfCell) {
    const std::set<std::string> values(valueOfCell.begin(), valueOfCell.end());
    if (values.size() < 2) return;
    report::ReportAxis axis;
    axis.name = name;
    axis.world = true;
    axis.values.assign(values.begin(), values.end());
    group.axes.push_back(std::move(axis));
    for (std::size_t cell = 0; cell < group.cells.size(); ++cell) group.cells[cell].settings[name] = valueOfCell[cell];
}

void fillCells(report::RunGroup& group, const std::vector<Drawn>& drawn, const measure::Metric& quality) {
    std::vector<std::string> references, machines, lengths;
    for (report::ReportCell& cell : group.cells) {
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
    report::ReportData data;
    std::size_t leftOut = 0;
    for (const Ranking& ranking : rankings.rankings)
        for (const MeasuredSetting& setting : ranking.settings) {
            leftOut += isDrawn(setting) ? 0 : 1;
            if (!isDrawn(setting)) continue;
            results::StoredRun run = standIn(ranking, setting, drawn.size());
            data.runs.emplace(run.runId, std::move(run));
            drawn.push_back({&ranking, &setting});
        }
    if (drawn.empty()) throw InputError(what + ": no setting has both a time and a quality that a chart can show");
    std::vector<const results::StoredRun*> standIns;
    report::MachineOfRun machineOfRun;
    for (const auto& [id, run] : data.runs) {
        standIns.push_back(&run);
        machineOfRun[id] = drawn[std::stoul(id)].ranking->machine;
    }
    report::RunGroup group = report::makeGroup(standIns, machineOfRun);
    group.id = groupId;
    group.chart.column = rankings.quality.column;
    group.budgetMs = budget.ms;
    fillCells(group, drawn, rankings.quality);
    data.groups.push_back(std::move(group));
    for (const MachineFacts& machine : runs.machines) data.machines.push_back(machine.fields);
    report::drawChart(data, std::string(groupId) + "-quality", file, what);
    return leftOut;
}

}  // namespace dustbench::recommend
