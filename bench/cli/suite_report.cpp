#include "bench/cli/suite_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

#include "bench/cli/commands.h"
#include "bench/cli/text_table.h"
#include "bench/results/freshness.h"
#include "bench/results/output_files.h"
#include "bench/results/stored_run.h"
#include "bench/results/temporary_folder.h"
#include "bench/run/progress.h"
#include "bench/suite/suite_evaluation.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

/// Tables of metrics with at most this many rows are transposed, because they are easier to read.
constexpr std::size_t maximumColumns = 6;

suite::TextRows transposed(const suite::TextRows& table) {
    suite::TextRows turned;
    turned.header.push_back("metric");
    for (const auto& row : table.rows) turned.header.push_back(row.front());
    for (std::size_t column = 1; column < table.header.size(); ++column) {
        turned.rows.push_back({table.header[column]});
        for (const auto& row : table.rows) turned.rows.back().push_back(row[column]);
    }
    return turned;
}

/// `invalid: ` and the text of saysInvalid; empty if all runs are valid.
std::string invalidLine(const std::vector<const results::StoredRun*>& runs) {
    const std::string said = results::saysInvalid(runs);
    return said.empty() ? "" : "invalid: " + files::printable(said) + "\n";
}

std::string textOf(suite::TextRows table) {
    table.rows.insert(table.rows.begin(), std::move(table.header));
    return textTable(table.rows);
}

std::string_view stateOf(const suite::PlannedRun& run, const fs::path& folder, results::Freshness& freshness) {
    if (!fs::exists(folder)) return run.skip.empty() ? "to do" : "left out";
    try {
        const results::StoredRun stored = results::readRunFolder(folder);
        return freshness.whyOutdated(stored).empty() ? results::runStatuses.wordOf(stored.status) : "outdated";
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

std::string sizeText(const results::ImageSize& size) {
    return fmt::format("{}x{}", size.width, size.height);
}

Varied variedOf(const suite::Suite& suite, const std::string& method) {
    Varied varied;
    for (const suite::PlannedRun& cell : suite.cells) {
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
std::string formText(const std::string& name, const suite::Suite& suite) {
    std::set<std::string> sizes, frames;
    std::vector<std::string> methods;
    for (const suite::PlannedRun& cell : suite.cells) {
        sizes.insert(sizeText(cell.spec.size));
        frames.insert(std::to_string(cell.spec.frames));
        if (std::ranges::find(methods, cell.spec.method) == methods.end()) methods.push_back(cell.spec.method);
    }
    std::string text = fmt::format("  {:<12} {} runs: {} configurations, {} repetition{}, {} frames of {}\n", name,
                                   suite::planRuns(suite).size(), suite.cells.size(), suite.repetitions,
                                   suite.repetitions == 1 ? "" : "s", fmt::join(frames, "/"), fmt::join(sizes, ", "));
    for (const std::string& method : methods)
        text += fmt::format("  {:<12}   {} {}\n", "", method, variedOf(suite, method).text());
    return text;
}

}  // namespace

std::string suiteReport(const suite::Suite& suite, const results::StoredRuns& runs) {
    const bool timed = suite::isTimed(suite, runs);
    std::string text =
        fmt::format("{}\n{}; {}\n", files::printable(suite.title),
                    timed ? "frames per second; ms per frame and per stage" : "not timed: counts and bytes",
                    suite.repetitions == 1 ? std::string("one run each")
                                           : fmt::format("medians over {} runs each", suite.repetitions));
    text += textOf(timed ? suite::tabulate(suite, runs) : suite::tabulateCounts(suite, runs));
    std::vector<const results::StoredRun*> all;
    for (const suite::PlannedRun& cell : suite.cells) {
        const auto done = suite::doneRuns(cell, suite.repetitions, runs);
        all.insert(all.end(), done.begin(), done.end());
    }
    text += invalidLine(all);
    if (suite::TextRows metrics = suite::tabulateMetrics(suite, runs); !metrics.rows.empty())
        text += "\nmetrics, means over the compared frames (reports/METRICS.md)\n" +
                textOf(metrics.rows.size() <= maximumColumns ? transposed(metrics) : std::move(metrics));
    for (const suite::FitResult& fit : suite::fitSuite(suite, runs)) {
        text += fmt::format("\ngrowth with N = {}: a + b·N^k, 95 % intervals\n", fit.against);
        text += textOf(suite::tabulate(fit));
    }
    for (const suite::ComparisonResult& comparison : suite::suiteVerdicts(suite, runs)) {
        text += fmt::format("\n{} against {}: ratio of times, 95 % interval over paired runs\n", comparison.of,
                            comparison.with);
        text += textOf(suite::tabulate(comparison));
        for (const std::string& sentence : suite::conclusions(comparison)) text += files::printable(sentence) + "\n";
    }
    return text;
}

std::string runsReport(const std::string& title, const std::vector<suite::MeasuredCell>& cells) {
    std::vector<const results::StoredRun*> all;
    for (const suite::MeasuredCell& cell : cells) all.insert(all.end(), cell.done.begin(), cell.done.end());
    return title + "\nframes per second; ms per frame and per stage; medians over the runs\n" +
           textOf(suite::tabulate(cells)) + invalidLine(all);
}

std::string publishedReport(suite::TextRows table) {
    return table.rows.empty() ? "" : "published numbers and ours\n" + textOf(std::move(table));
}

std::string claimsReport(const std::vector<claims::EvaluatedClaim>& claims) {
    if (claims.empty()) return "";
    return "claims\n" + textOf(claims::tabulate(claims));
}

std::vector<suite::PlannedRun> printPlan(const std::vector<suite::PlannedRun>& plan, int repetitions,
                                         const fs::path& out) {
    results::Freshness freshness;
    std::vector<suite::PlannedRun> toDo;
    std::uint64_t bytes = 0;
    for (const suite::PlannedRun& run : plan) {
        const std::string id = results::runId(run.spec);
        const std::string_view state = stateOf(run, out / "runs" / id, freshness);
        if (state == "to do" || state == "damaged") {
            toDo.push_back(run);
            bytes += results::maximumBytesOf(run.spec);
        }
        std::cout << files::printable(fmt::format("{}  {:<8}  {} {} {}{}rep {}/{}", id, state, run.spec.method,
                                                  run.spec.scene, run.label, run.label.empty() ? "" : " ",
                                                  run.spec.repetition, repetitions))
                  << "\n";
    }
    std::cerr << fmt::format("{} runs, {} to do, which take up at most {}\n", plan.size(), toDo.size(),
                             results::bytesText(bytes));
    return toDo;
}

int printEstimate(const std::vector<suite::PlannedRun>& toDo, PlanOptions options) {
    if (toDo.empty()) return exitOk;
    requireOpenGl();
    std::cerr << "estimate: starting one run of each configuration" << std::endl;
    const results::TemporaryFolder folder;
    results::ResultsFolder results(folder.path());
    const run::PlanForecast forecast = forecastRuns(toDo, results, options);
    if (forecast.aborted) return exitAborted;
    for (const std::string& warning : forecast.warnings)
        std::cerr << "warning: " << files::printable(warning) << std::endl;
    std::cerr << fmt::format("estimate: {} for {} run{}", run::durationText(forecast.seconds), forecast.runs,
                             forecast.runs == 1 ? "" : "s")
              << std::endl;
    return exitOk;
}

std::string describeSuite(const std::string& id) {
    const suite::SuiteForms forms = suite::loadForms(id);
    const suite::Suite& full = forms.full;
    std::string text;
    for (const suite::SuiteFile& suite : suite::listSuites())
        if (suite.id == id) {
            text += fmt::format("  {:<12} {}\n", "file", suite.file.string());
            if (!suite.paper.empty()) text += fmt::format("  {:<12} {}\n", "paper", suite.paper);
        }
    if (!full.chart.column.empty())
        text += fmt::format("  {:<12} {}{}{}\n", "chart", full.chart.column,
                            full.chart.against.empty() ? "" : " against ", full.chart.against);
    text += formText("full", full) + formText("--quick", forms.quick.value_or(full));
    for (const suite::PlannedComparison& comparison : full.comparisons)
        text += fmt::format("  {:<12} {} with {}: {}\n", "compares", comparison.of.label, comparison.with.label,
                            fmt::join(comparison.columns, ", "));
    for (const suite::PlannedFit& fit : full.fits)
        text += fmt::format("  {:<12} {} against {}\n", "fits", fmt::join(fit.columns, ", "), fit.against);
    return text;
}

}  // namespace dustbench::cli
