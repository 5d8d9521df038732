// `dustbench recommend`: recommends a method and its settings for a time budget, from results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/cli/text_table.h"
#include "bench/recommend/rankings.h"
#include "bench/recommend/recommendation.h"
#include "bench/recommend/recommendation_output.h"
#include "bench/suite/value_list.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/adapter.h"

namespace dustbench::cli {
namespace {

using measure::Metric;
using recommend::MeasuredSetting;
using recommend::Ranking;
using recommend::Recommendation;
using report::MedianInterval;

// --- The answer as text: for each world its flaws, and the machines and runs that it is based on

/// Minimum number of values for a 95 % interval (median_interval.h).
constexpr std::size_t enoughValues = 6;
constexpr std::size_t namedIncomplete = 6;

std::string digitsOf(double value) {
    if (std::isnan(value)) return "";
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : "identical";
}

std::string milliseconds(double ms) {
    return fmt::format("{:.{}f}", ms, std::abs(ms) < 1 ? 3 : 2);
}

std::string decibels(double value) {
    return std::isfinite(value) ? fmt::format("{:.2f}", value) : "identical";
}

std::string qualityOf(double value, const measure::Metric& metric) {
    return metric.unit == "dB" ? decibels(value) : fixed(value, 4);
}

/// `3.11 ms (2.93 to 5.18, 6 runs)`
std::string timeText(const recommend::MeasuredSetting& setting) {
    const report::MedianInterval& ms = setting.ms;
    const char* const of = setting.timedSeeds > 1 ? "seed" : "run";
    if (ms.values < 2) return fmt::format("{} ms (one run)", milliseconds(ms.median));
    return fmt::format("{} ms ({} to {}, {} {}s)", milliseconds(ms.median), milliseconds(ms.low), milliseconds(ms.high),
                       ms.values, of);
}

/// `31.66 dB (one seed)`
std::string qualityText(const recommend::MeasuredSetting& setting, const measure::Metric& metric) {
    const report::MedianInterval& quality = setting.quality;
    const bool hasUnit = !metric.unit.empty() && std::isfinite(quality.median);
    const std::string value = fmt::format("{} {}{}{}", metric.column, qualityOf(quality.median, metric),
                                          hasUnit ? " " : "", hasUnit ? metric.unit : "");
    if (quality.values < 2) return value + " (one seed)";
    return fmt::format("{} ({} to {}, {} seeds)", value, qualityOf(quality.low, metric),
                       qualityOf(quality.high, metric), quality.values);
}

std::string lineOf(const std::string& head, const recommend::MeasuredSetting& setting, const measure::Metric& metric) {
    return fmt::format("  {:<15} {}: {}, {}\n", head, setting.label, timeText(setting), qualityText(setting, metric));
}

std::string answerText(const recommend::Ranking& ranking, const recommend::Recommendation& answer,
                       const recommend::Rankings& rankings, const recommend::Budget& budget) {
    const measure::Metric& metric = rankings.quality;
    std::string text;
    if (answer.recommended) {
        text += lineOf("recommended", ranking.settings[*answer.recommended], metric);
        for (const std::size_t index : answer.equallyGood)
            text += lineOf("equally good", ranking.settings[index], metric);
    } else {
        const recommend::MeasuredSetting& cheapest = ranking.settings[answer.cheapest];
        text += fmt::format("  nothing fits {:g} ms; the cheapest is {}: {}, {}\n", budget.ms, cheapest.label,
                            timeText(cheapest), qualityText(cheapest, metric));
    }
    if (answer.betterBeyond && answer.recommended)
        text += lineOf("over budget", ranking.settings[*answer.betterBeyond], metric);
    return text;
}

std::vector<std::string> rowOf(const recommend::MeasuredSetting& setting, const measure::Metric& metric,
                               double budgetMs) {
    const report::MedianInterval &ms = setting.ms, &quality = setting.quality;
    const bool isTimedOnce = ms.values < 2, isOneSeed = quality.values < 2;
    return {setting.label,
            recommend::fits(setting, budgetMs) ? "yes" : "no",
            milliseconds(ms.median),
            isTimedOnce ? "" : milliseconds(ms.low),
            isTimedOnce ? "" : milliseconds(ms.high),
            fmt::format("{}", ms.values),
            qualityOf(quality.median, metric),
            isOneSeed ? "" : qualityOf(quality.low, metric),
            isOneSeed ? "" : qualityOf(quality.high, metric),
            fmt::format("{}", quality.values),
            setting.onFront ? "front" : ""};
}

std::string settingsTable(const recommend::Ranking& ranking, const measure::Metric& metric, double budgetMs) {
    std::vector<std::vector<std::string>> rows{
        {"setting", "fits", "ms", "low", "high", "n", std::string(metric.column), "low", "high", "seeds", "pareto"}};
    for (const recommend::MeasuredSetting& setting : ranking.settings) rows.push_back(rowOf(setting, metric, budgetMs));
    return textTable(rows);
}

std::string valueText(const recommend::MeasuredSetting& setting, const measure::Metric& metric) {
    const auto found = setting.metrics.find(metric.column);
    if (found == setting.metrics.end()) return "-";
    const report::MedianInterval& value = found->second;
    if (value.values < 2) return digitsOf(value.median);
    return fmt::format("{} ({} to {})", digitsOf(value.median), digitsOf(value.low), digitsOf(value.high));
}

/// The flaws of the recommended setting compared with those of alternatives.
std::string flawTable(const recommend::Ranking& ranking, const recommend::Recommendation& answer) {
    std::vector<std::size_t> shown{answer.recommended.value_or(answer.cheapest)};
    constexpr std::size_t mostOthers = 2;
    for (const std::size_t index : answer.equallyGood)
        if (shown.size() < mostOthers) shown.push_back(index);
    if (answer.betterBeyond && *answer.betterBeyond != shown.front()) shown.push_back(*answer.betterBeyond);

    std::vector<std::vector<std::string>> rows{{"metric", "unit", "perfect"}};
    for (const std::size_t index : shown) rows.front().push_back(ranking.settings[index].label);
    const auto add = [&](const measure::Metric& metric) {
        std::vector<std::string> row{std::string(metric.column), std::string(metric.unit), std::string(metric.perfect)};
        for (const std::size_t index : shown) row.push_back(valueText(ranking.settings[index], metric));
        if (std::any_of(row.begin() + 3, row.end(), [](const std::string& cell) { return cell != "-"; }))
            rows.push_back(std::move(row));
    };
    std::ranges::for_each(recommend::qualityMetrics(), add);
    std::ranges::for_each(recommend::flawMetrics(), add);
    return textTable(rows);
}

std::string valueOf(const recommend::SettingTexts& fields, std::string_view name) {
    const auto found = fields.find(name);
    return found == fields.end() ? "" : found->second;
}

/// `measured on: AMD EPYC, 2 cores, llvmpipe (LLVM 15.0.6, 256 bits); commit 30176ec67599`
std::string machineText(const recommend::MachineFacts& machine, const std::string& number) {
    if (machine.fields.empty())
        return fmt::format("measured on{}: unknown, because there is no machine.csv next to summary.csv\n", number);
    std::vector<std::string> commits;
    commits.reserve(machine.commits.size());
    constexpr std::size_t shortCommit = 12;
    for (const std::string& commit : machine.commits)
        commits.push_back(commit.empty() ? "outside git" : commit.substr(0, shortCommit));
    const std::string renderer = valueOf(machine.fields, "gl_renderer");
    std::string text =
        fmt::format("measured on{}: {}, {} cores, {}; commit {}\n", number, valueOf(machine.fields, "cpu"),
                    valueOf(machine.fields, "cores"), renderer, fmt::join(commits, ", "));
    if (gpu::isSoftwareRenderer(renderer))
        text += "warning: software renderer: the CPU drew the pictures; on a GPU, other settings may fit and lead\n";
    if (commits.size() > 1) text += "warning: times of several builds are combined\n";
    return text;
}

std::string wayOfMeasuring(const recommend::Ranking& ranking) {
    return fmt::format(
        "timed with sync={} threads={} over {} frames, compared over {} frames with {}",
        valueOf(ranking.conduct, "sync"), valueOf(ranking.conduct, "threads"), valueOf(ranking.conduct, "frames"),
        ranking.evaluatedFrames,
        ranking.reference.empty() || ranking.reference == "exact" ? "the ground truth" : ranking.reference);
}

std::string rankingText(const recommend::Ranking& ranking, const recommend::Recommendation& answer,
                        const recommend::Rankings& rankings, const recommend::Budget& budget, bool severalMachines) {
    std::string text = ranking.label;
    if (severalMachines) text += fmt::format(" (machine {})", ranking.machine + 1);
    text += "\n" + answerText(ranking, answer, rankings, budget) + "\n";
    text += settingsTable(ranking, rankings.quality, budget.ms) + "\n" + flawTable(ranking, answer);
    text += "(" + wayOfMeasuring(ranking) + ")\n";
    const auto joined = std::ranges::count_if(ranking.settings, &recommend::MeasuredSetting::otherRuns);
    if (joined > 0)
        text += fmt::format("(for {} of {} settings, pictures and times are from different runs)\n", joined,
                            ranking.settings.size());
    return text;
}

/// Explains the intervals and warns of too few values.
std::string statisticsText(const recommend::Rankings& rankings) {
    bool hasFewRuns = false, hasFewSeeds = false, hasOneSeed = false;
    for (const recommend::Ranking& ranking : rankings.rankings)
        for (const recommend::MeasuredSetting& setting : ranking.settings) {
            hasFewRuns |= setting.ms.values < enoughValues;
            hasFewSeeds |= setting.quality.values > 1 && setting.quality.values < enoughValues;
            hasOneSeed |= setting.quality.values < 2;
        }
    std::string text =
        "Values are medians over n repetitions or seeds. The true median is between low and high with a probability of "
        "95 % or more.\n";
    if (hasFewRuns || hasFewSeeds)
        text += "warning: fewer than 6 values: low and high are their minimum and maximum, not a 95 % interval\n";
    if (hasOneSeed) text += "warning: pictures of one seed have no interval: small differences may be chance\n";
    return text;
}

std::string namesOfSettings(const std::vector<const recommend::Incomplete*>& settings, std::string_view what) {
    if (settings.empty()) return "";
    std::string text = fmt::format("{} ({}):\n", what, settings.size());
    for (std::size_t index = 0; index < std::min(settings.size(), namedIncomplete); ++index)
        text += fmt::format("  {}: {}\n", settings[index]->world, settings[index]->label);
    if (settings.size() > namedIncomplete)
        text += fmt::format("  … and {} more, listed by --json\n", settings.size() - namedIncomplete);
    return text;
}

/// Escapes control characters in each line.
std::string printableLines(const std::string& text) {
    std::string safe;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        safe += files::printable(std::string_view(text).substr(begin, end - begin)) + "\n";
        begin = end + 1;
    }
    return safe;
}

/// How many runs are left out, and why; empty if all are used.
std::string leftOutText(const recommend::MeasuredRuns& runs) {
    std::string text;
    if (runs.notDone > 0) text += fmt::format("left out: {} runs that did not complete\n", runs.notDone);
    for (const auto& [why, count] : runs.whyInvalid)
        text += fmt::format("left out: {} invalid run{}: {}\n", count, count == 1 ? "" : "s", why);
    return printableLines(text);
}

/// Settings that have a time or a quality but not both, and those that have neither; empty if there are none.
std::string incompleteText(const recommend::Rankings& rankings) {
    std::vector<const recommend::Incomplete*> timed, evaluated, both;
    std::size_t neither = 0;
    for (const recommend::Incomplete& setting : rankings.incomplete) {
        if (setting.hasTime && setting.hasQuality) both.push_back(&setting);
        if (setting.hasTime && !setting.hasQuality) timed.push_back(&setting);
        if (!setting.hasTime && setting.hasQuality) evaluated.push_back(&setting);
        neither += setting.hasTime || setting.hasQuality ? 0 : 1;
    }
    std::string text =
        namesOfSettings(timed, fmt::format("not ranked: a time but no {}", rankings.quality.column)) +
        namesOfSettings(evaluated, fmt::format("not ranked: {} but no time of the method", rankings.quality.column)) +
        namesOfSettings(both,
                        "not ranked: compared over different frames or with a different reference from the others");
    if (neither > 0)
        text += fmt::format("not ranked: {} settings with neither, run without the null method and metrics\n", neither);
    return printableLines(text);
}

/// `recommendations` contains one for each ranking, in the same order.
std::string recommendationText(const recommend::Budget& budget, const recommend::MeasuredRuns& runs,
                               const recommend::Rankings& rankings,
                               const std::vector<recommend::Recommendation>& recommendations) {
    std::string text = fmt::format(
        "budget: {}, that is {:.4g} ms of each frame for the method alone. A setting fits if the upper end of "
        "the interval of {} is within it.\n",
        budget.asked, budget.ms, recommend::timeColumn);
    for (std::size_t index = 0; index < rankings.rankings.size(); ++index)
        text += "\n" + rankingText(rankings.rankings[index], recommendations[index], rankings, budget,
                                   runs.machines.size() > 1);
    text += "\n" + statisticsText(rankings);
    for (std::size_t index = 0; index < runs.machines.size(); ++index)
        text += machineText(runs.machines[index], runs.machines.size() > 1 ? fmt::format(" {}", index + 1) : "");
    return printableLines(text) + leftOutText(runs) + incompleteText(rankings);
}

// --- The command

struct RecommendOptions {
    std::string from, budget, quality = "psnr_mask_db", scene, light, chart;
    std::vector<std::string> where;
    bool json = false;
};

std::string qualityNames() {
    std::vector<std::string_view> names;
    for (const measure::Metric& metric : recommend::qualityMetrics()) names.push_back(metric.column);
    return fmt::format("{}", fmt::join(names, "|"));
}

std::vector<recommend::Condition> conditionsOf(const RecommendOptions& options) {
    std::vector<recommend::Condition> conditions;
    if (!options.scene.empty()) conditions.push_back({"--scene", "scene", {options.scene}});
    if (!options.light.empty()) conditions.push_back({"--light", "light", {options.light}});
    for (const std::string& text : options.where) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw InputError("--where: got '" + text + "', expected name=value");
        const std::string key = text.substr(0, equals);
        conditions.push_back({"--where", key, suite::expandValues(key, text.substr(equals + 1))});
    }
    return conditions;
}

void drawChart(const RecommendOptions& options, const recommend::Rankings& rankings,
               const recommend::MeasuredRuns& runs, const recommend::Budget& budget) {
    const std::size_t leftOut = recommend::drawRecommendation(rankings, runs, budget, options.chart, "--chart");
    std::cerr << "note: " << files::printable(options.chart)
              << " written; rings and the line mark the Pareto front, where "
              << "intervals do not overlap\n";
    if (leftOut > 0)
        std::cerr << "note: " << leftOut
                  << " settings are not in the chart because their pictures are identical to the reference\n";
}

/// Prints on stderr why there is nothing to rank.
int refuse(const recommend::MeasuredRuns& runs, const recommend::Rankings& rankings) {
    const std::string why = fmt::format(
        "'{}': no setting has both {} and {}; `compare` and suites with `baseline` and `metrics` measure both",
        runs.from, recommend::timeColumn, rankings.quality.column);
    std::cerr << files::printable(why) << "\n" << leftOutText(runs) << incompleteText(rankings);
    return exitNotComparable;
}

int recommend(const RecommendOptions& options) {
    const recommend::Budget budget = recommend::parseBudget("--budget", options.budget);
    const measure::Metric quality = recommend::qualityMetric("--quality", options.quality);
    recommend::MeasuredRuns runs = recommend::readMeasuredRuns(options.from);
    recommend::narrow(runs, conditionsOf(options));
    const recommend::Rankings rankings = recommend::rankSettings(runs, quality);
    if (rankings.rankings.empty()) return refuse(runs, rankings);

    std::vector<recommend::Recommendation> answers;
    answers.reserve(rankings.rankings.size());
    for (const recommend::Ranking& ranking : rankings.rankings)
        answers.push_back(recommend::recommend(ranking, quality, budget.ms));
    if (!options.chart.empty()) drawChart(options, rankings, runs, budget);
    std::cout << (options.json ? recommend::recommendationJson(budget, runs, rankings, answers)
                               : recommendationText(budget, runs, rankings, answers));
    const bool hasAnswer = std::ranges::any_of(
        answers, [](const recommend::Recommendation& answer) { return answer.recommended.has_value(); });
    return hasAnswer ? exitOk : exitNothingFits;
}

}  // namespace

Command recommendCommand() {
    auto options = std::make_shared<RecommendOptions>();
    return {
        "recommend", "Recommend a method and its settings for a time budget, from results",
        "One answer for each world (load, speed, scene, size …). A setting fits if the upper end of the interval of\n"
        "its method_ms_median is within the budget. Of these, the one with the best picture leads. Of the leader and\n"
        "all whose intervals of quality overlap its own, the fastest is recommended.\n"
        "Exit code 5: nothing fits in any world; 6: no setting has both a time and a quality.",
        [options](Arguments& arguments) {
            arguments.required("--from", "DIR|FILE", "a results folder, or a summary.csv", options->from);
            arguments.required("--budget", "TIME",
                               "time that the method may add to a frame: 4ms; or 60fps for 1000/60 ms",
                               options->budget);
            arguments.text("--scene", "NAME", "answer for this scene only", options->scene);
            arguments.text("--light", "NAME", "answer for this light only", options->light);
            arguments.texts("--where", "NAME=VALUE",
                            "answer for these worlds or settings only: particles=500, size=320x240, "
                            "method=billboard; values may be lists and ranges; may be given several times",
                            options->where);
            arguments.text("--quality", qualityNames(), "metric that ranks pictures; default: psnr_mask_db",
                           options->quality);
            arguments.text("--chart", "FILE", "also draw quality against time: .svg, .png or .pdf", options->chart);
            arguments.flag("--json", "print JSON: an object with all settings and their metrics", options->json);
        },
        [options] { return recommend(*options); }};
}

}  // namespace dustbench::cli
