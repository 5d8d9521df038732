// `dustbench recommend`: recommends a method and its settings for a time budget, from results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/recommendation_text.h"
#include "bench/recommend/recommendation_chart.h"
#include "bench/recommend/recommendation_json.h"
#include "bench/suite/value_list.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

struct RecommendOptions {
    std::string from, budget, quality = "psnr_mask_db", scene, light, chart;
    std::vector<std::string> where;
    bool json = false;
};

std::string qualityNames() {
    std::vector<std::string_view> names;
    for (const bench::Metric& metric : bench::qualityMetrics()) names.push_back(metric.column);
    return fmt::format("{}", fmt::join(names, "|"));
}

std::vector<bench::Condition> conditionsOf(const RecommendOptions& options) {
    std::vector<bench::Condition> conditions;
    if (!options.scene.empty()) conditions.push_back({"--scene", "scene", {options.scene}});
    if (!options.light.empty()) conditions.push_back({"--light", "light", {options.light}});
    for (const std::string& text : options.where) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos)
            throw InputError("--where: got '" + text + "', expected name=value");
        const std::string key = text.substr(0, equals);
        conditions.push_back({"--where", key, bench::expandValues(key, text.substr(equals + 1))});
    }
    return conditions;
}

void drawChart(const RecommendOptions& options, const bench::Rankings& rankings, const bench::MeasuredRuns& runs,
               const bench::Budget& budget) {
    const std::size_t leftOut = bench::drawRecommendation(rankings, runs, budget, options.chart, "--chart");
    std::cerr << "note: " << files::printable(options.chart)
              << " written; rings and the line mark the Pareto front, where "
              << "intervals do not overlap\n";
    if (leftOut > 0)
        std::cerr << "note: " << leftOut
                  << " settings are not in the chart because their pictures are identical to the reference\n";
}

/// Prints on stderr why there is nothing to rank.
int refuse(const bench::MeasuredRuns& runs, const bench::Rankings& rankings) {
    const std::string why = fmt::format(
        "'{}': no setting has both {} and {}; `compare` and suites with `baseline` and `metrics` measure both",
        runs.from, bench::timeColumn, rankings.quality.column);
    std::cerr << files::printable(why) << "\n" << leftOutText(runs) << incompleteText(rankings);
    return exitNotComparable;
}

int recommend(const RecommendOptions& options) {
    const bench::Budget budget = bench::parseBudget("--budget", options.budget);
    const bench::Metric quality = bench::qualityMetric("--quality", options.quality);
    bench::MeasuredRuns runs = bench::readMeasuredRuns(options.from);
    bench::narrow(runs, conditionsOf(options));
    const bench::Rankings rankings = bench::rankSettings(runs, quality);
    if (rankings.rankings.empty()) return refuse(runs, rankings);

    std::vector<bench::Recommendation> answers;
    answers.reserve(rankings.rankings.size());
    for (const bench::Ranking& ranking : rankings.rankings)
        answers.push_back(bench::recommend(ranking, quality, budget.ms));
    if (!options.chart.empty()) drawChart(options, rankings, runs, budget);
    std::cout << (options.json ? bench::recommendationJson(budget, runs, rankings, answers)
                               : recommendationText(budget, runs, rankings, answers));
    const bool hasAnswer = std::ranges::any_of(
        answers, [](const bench::Recommendation& answer) { return answer.recommended.has_value(); });
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
