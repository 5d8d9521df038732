#include "bench/cli/suite_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "bench/cli/exit_codes.h"
#include "bench/cli/suite_report.h"
#include "bench/results/freshness.h"
#include "bench/results/output_files.h"
#include "bench/results/stored_run.h"
#include "bench/results/temporary_folder.h"
#include "bench/run/progress.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

std::string_view stateOf(const bench::PlannedRun& run, const fs::path& folder, bench::Freshness& freshness) {
    if (!fs::exists(folder)) return run.skip.empty() ? "to do" : "left out";
    try {
        const bench::StoredRun stored = bench::readRunFolder(folder);
        return freshness.whyOutdated(stored).empty() ? bench::runStatuses.wordOf(stored.status) : "outdated";
    } catch (const InputError&) {
        return "damaged";  // set aside and measured again
    }
}

/// The settings in which the configurations of one method differ, with their values in order.
class Varied {
 public:
    void add(const std::string& name, const std::string& value) {
        auto known = std::ranges::find(values_, name, &std::pair<std::string, std::vector<std::string>>::first);
        if (known == values_.end()) known = values_.insert(values_.end(), {name, {}});
        if (std::ranges::find(known->second, value) == known->second.end()) known->second.push_back(value);
    }
    [[nodiscard]] std::string text() const {
        std::string text;
        for (const auto& [name, list] : values_)
            if (list.size() > 1) text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, fmt::join(list, ","));
        return text;
    }

 private:
    std::vector<std::pair<std::string, std::vector<std::string>>> values_;
};

std::string sizeText(const bench::ImageSize& size) {
    return fmt::format("{}x{}", size.width, size.height);
}

Varied variedOf(const bench::Suite& suite, const std::string& method) {
    Varied varied;
    for (const bench::PlannedRun& cell : suite.cells) {
        if (cell.spec.method != method) continue;
        varied.add("scene", cell.spec.scene);
        varied.add("drive", cell.spec.drive);
        varied.add("size", sizeText(cell.spec.size));
        varied.add("seed", std::to_string(cell.spec.seed));
        for (const auto& [name, value] : cell.spec.parameters) varied.add(name, value);
    }
    return varied;
}

/// `80 runs: 40 configurations, 2 repetitions, 120 frames of 640x480`, and a line for each method.
std::string formText(const std::string& name, const bench::Suite& suite) {
    std::set<std::string> sizes, frames;
    std::vector<std::string> methods;
    for (const bench::PlannedRun& cell : suite.cells) {
        sizes.insert(sizeText(cell.spec.size));
        frames.insert(std::to_string(cell.spec.frames));
        if (std::ranges::find(methods, cell.spec.method) == methods.end()) methods.push_back(cell.spec.method);
    }
    std::string text = fmt::format("  {:<12} {} runs: {} configurations, {} repetition{}, {} frames of {}\n", name,
                                   bench::planRuns(suite).size(), suite.cells.size(), suite.repetitions,
                                   suite.repetitions == 1 ? "" : "s", fmt::join(frames, "/"), fmt::join(sizes, ", "));
    for (const std::string& method : methods)
        text += fmt::format("  {:<12}   {} {}\n", "", method, variedOf(suite, method).text());
    return text;
}

}  // namespace

std::vector<bench::PlannedRun> printPlan(const std::vector<bench::PlannedRun>& plan, int repetitions,
                                         const fs::path& out) {
    bench::Freshness freshness;
    std::vector<bench::PlannedRun> toDo;
    std::uint64_t bytes = 0;
    for (const bench::PlannedRun& run : plan) {
        const std::string id = bench::runId(run.spec);
        const std::string_view state = stateOf(run, out / "runs" / id, freshness);
        if (state == "to do" || state == "damaged") {
            toDo.push_back(run);
            bytes += bench::maximumBytesOf(run.spec);
        }
        std::cout << files::printable(fmt::format("{}  {:<8}  {} {} {}{}rep {}/{}", id, state, run.spec.method,
                                                  run.spec.scene, run.label, run.label.empty() ? "" : " ",
                                                  run.spec.repetition, repetitions))
                  << "\n";
    }
    std::cerr << fmt::format("{} runs, {} to do, which take up at most {}\n", plan.size(), toDo.size(),
                             bench::bytesText(bytes));
    return toDo;
}

int printEstimate(const std::vector<bench::PlannedRun>& toDo, PlanOptions options) {
    if (toDo.empty()) return exitOk;
    requireOpenGl();
    std::cerr << "estimate: starting one run of each configuration" << std::endl;
    const bench::TemporaryFolder folder;
    bench::ResultsFolder results(folder.path());
    const bench::PlanForecast forecast = forecastRuns(toDo, results, options);
    if (forecast.aborted) return exitAborted;
    for (const std::string& warning : forecast.warnings)
        std::cerr << "warning: " << files::printable(warning) << std::endl;
    std::cerr << fmt::format("estimate: {} for {} run{}", bench::durationText(forecast.seconds), forecast.runs,
                             forecast.runs == 1 ? "" : "s")
              << std::endl;
    return exitOk;
}

std::string describeSuite(const std::string& id) {
    const bench::Suite full = bench::loadSuite(id, false), quick = bench::loadSuite(id, true);
    std::string text;
    for (const bench::SuiteFile& suite : bench::listSuites())
        if (suite.id == id) {
            text += fmt::format("  {:<12} {}\n", "file", suite.file.string());
            if (!suite.paper.empty()) text += fmt::format("  {:<12} {}\n", "paper", suite.paper);
        }
    if (!full.chart.column.empty())
        text += fmt::format("  {:<12} {}{}{}\n", "chart", full.chart.column,
                            full.chart.against.empty() ? "" : " against ", full.chart.against);
    text += formText("full", full) + formText("--quick", quick);
    for (const bench::PlannedComparison& comparison : full.comparisons)
        text += fmt::format("  {:<12} {} with {}: {}\n", "compares", comparison.of.label, comparison.with.label,
                            fmt::join(comparison.columns, ", "));
    for (const bench::PlannedFit& fit : full.fits)
        text += fmt::format("  {:<12} {} against {}\n", "fits", fmt::join(fit.columns, ", "), fit.against);
    return text;
}

}  // namespace dustbench::cli
