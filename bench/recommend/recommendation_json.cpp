#include "bench/recommend/recommendation_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace dustbench::bench {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json intervalJson(const MedianInterval& interval) {
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

}  // namespace dustbench::bench
