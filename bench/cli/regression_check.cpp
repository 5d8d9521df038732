#include "bench/cli/regression_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/text_table.h"
#include "bench/export/whole_file.h"
#include "bench/results/compared_runs.h"
#include "bench/results/freshness.h"
#include "bench/results/stored_run.h"
#include "bench/results/temporary_folder.h"
#include "bench/suite/planned_evaluation.h"
#include "bench/suite/regression/folder_comparison.h"
#include "bench/suite/regression/regression_table.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

// --- Suspected regressions, measured again so that chance alone does not fail the comparison

/// A suspected regression: a column of one configuration, or of all together (null).
struct Alert {
    const suite::FolderCell* cell;
    std::string column;
};

class SecondLook {
 public:
    /// Measures the configurations of `alerts` again with this program, each as often as in B, and compares them with
    /// A. The runs are written to `folder`. Measures nothing if B is from another build or its inputs have changed
    /// (whyNot).
    SecondLook(const suite::ResultsSide& a, const suite::FolderComparison& first, const std::vector<Alert>& alerts,
               double percent, const std::filesystem::path& folder);

    /// Empty if it was measured.
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }
    [[nodiscard]] bool aborted() const { return aborted_; }
    /// The alert's result in the second measurement; null if there is none.
    [[nodiscard]] const suite::EvaluatedCell* evaluated(const Alert& alert) const;
    /// True if the second measurement alerts again or could not decide.
    [[nodiscard]] bool confirms(const Alert& alert) const;

 private:
    double percent_;
    std::string whyNot_;
    bool aborted_ = false;
    suite::ResultsSide a_, b_;
    suite::FolderComparison comparison_;
};

/// The configurations to measure: those that alert, or all of them if their mean alerts.
std::vector<const suite::FolderCell*> cellsOf(const suite::FolderComparison& first, const std::vector<Alert>& alerts) {
    const bool ofAll = std::ranges::any_of(alerts, [](const Alert& alert) { return alert.cell == nullptr; });
    std::vector<const suite::FolderCell*> cells;
    for (const suite::FolderCell& cell : first.cells) {
        const bool alerting = std::ranges::any_of(alerts, [&](const Alert& alert) { return alert.cell == &cell; });
        if (!cell.a.done.empty() && !cell.b.done.empty() && (ofAll || alerting)) cells.push_back(&cell);
    }
    return cells;
}

/// Plans one repetition of all configurations after the other, as a suite does.
std::vector<suite::PlannedRun> planOf(const std::vector<const suite::FolderCell*>& cells, int& repetitions) {
    std::vector<suite::PlannedRun> plan;
    repetitions = 0;
    for (const suite::FolderCell* cell : cells)
        repetitions = std::max(repetitions, static_cast<int>(cell->b.done.size()));
    for (int repetition = 1; repetition <= repetitions; ++repetition)
        for (const suite::FolderCell* cell : cells)
            if (repetition <= static_cast<int>(cell->b.done.size())) {
                suite::PlannedRun& run = plan.emplace_back();
                run.spec = suite::inRepetition(results::specFromKey(*cell->b.done.front()), repetition);
            }
    return plan;
}

SecondLook::SecondLook(const suite::ResultsSide& a, const suite::FolderComparison& first,
                       const std::vector<Alert>& alerts, double percent, const std::filesystem::path& folder)
    : percent_(percent), a_{a.name, {}} {
    const std::vector<const suite::FolderCell*> cells = cellsOf(first, alerts);
    results::Freshness freshness;
    for (const suite::FolderCell* cell : cells) {
        for (const results::StoredRun* run : cell->b.done)
            if (whyNot_.empty()) whyNot_ = freshness.whyOutdated(*run);
        for (const results::StoredRun* run : cell->a.done) a_.runs.emplace(run->runId, *run);
    }
    if (cells.empty()) whyNot_ = "no configuration is complete in both folders";
    if (!whyNot_.empty()) return;

    int repetitions = 0;
    const std::vector<suite::PlannedRun> plan = planOf(cells, repetitions);
    requireOpenGl();
    results::ResultsFolder results(folder);
    PlanOptions options;
    options.force = true;
    aborted_ = runPlan(plan, repetitions, results, options) == exitAborted;
    b_ = {folder.string(), results.runs()};
    std::set<std::string> columns;
    for (const Alert& alert : alerts) columns.insert(alert.column);
    comparison_ = suite::compareFolders(a_, b_, {columns.begin(), columns.end()}, false);
    if (!comparison_.obstacles.empty()) whyNot_ = comparison_.obstacles.front();
}

const suite::EvaluatedCell* SecondLook::evaluated(const Alert& alert) const {
    for (const suite::EvaluatedCell& evaluated : comparison_.evaluated) {
        const bool isIt = alert.cell == nullptr
                              ? evaluated.cell == nullptr
                              : evaluated.cell != nullptr && evaluated.cell->identity == alert.cell->identity;
        if (isIt && evaluated.column == alert.column) return &evaluated;
    }
    return nullptr;
}

bool SecondLook::confirms(const Alert& alert) const {
    const suite::EvaluatedCell* again = evaluated(alert);
    return again == nullptr || !again->result.hasEnough() || suite::isSlowerBy(*again, percent_);
}

// --- The comparison

std::vector<std::string> parseColumns(const std::string& text) {
    if (text.empty()) return {"frame_ms_median"};
    const std::vector<std::string> known = suite::comparableColumns();
    std::vector<std::string> columns;
    std::istringstream words(text + ",");
    for (std::string word; std::getline(words, word, ',');) {
        if (std::ranges::find(known, word) == known.end()) throw unknownName("column to compare", word, known);
        if (std::ranges::find(columns, word) != columns.end())
            throw InputError(fmt::format("--columns: got '{}' twice", word));
        columns.push_back(word);
    }
    return columns;
}

void writeCsv(const std::string& folder, const std::string& text) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) files::failWriting(folder, error.value());
    const std::filesystem::path file = std::filesystem::path(folder) / "comparison.csv";
    exports::writeWhole(file, text);
    std::cout << file.string() << "\n";
}

std::string takes(const suite::EvaluatedCell& evaluated) {
    return fmt::format("takes {:.4g} [{:.4g}, {:.4g}] times as long in B", evaluated.result.ratio, evaluated.result.low,
                       evaluated.result.high);
}

std::vector<Alert> alertsOf(const suite::FolderComparison& comparison, double percent) {
    std::vector<Alert> alerts;
    for (const suite::EvaluatedCell& evaluated : comparison.evaluated)
        if (suite::isSlowerBy(evaluated, percent)) alerts.push_back({evaluated.cell, evaluated.column});
    return alerts;
}

/// Prints which alerts are confirmed and which are not; returns the confirmed ones.
std::vector<Alert> confirmed(const suite::FolderComparison& comparison, const std::vector<Alert>& alerts,
                             const SecondLook& second) {
    std::vector<Alert> standing;
    for (const Alert& alert : alerts) {
        const auto first = std::ranges::find_if(comparison.evaluated, [&](const suite::EvaluatedCell& evaluated) {
            return evaluated.cell == alert.cell && evaluated.column == alert.column;
        });
        const suite::EvaluatedCell* again = second.whyNot().empty() ? second.evaluated(alert) : nullptr;
        const bool stands = !second.whyNot().empty() || second.confirms(alert);
        if (stands) standing.push_back(alert);
        std::cerr << fmt::format(
            "{}: {}: {} {}{}\n", stands ? "regression" : "not confirmed", alert.column,
            alert.cell ? suite::labelOf(*alert.cell, comparison.axes) : "the mean of all configurations", takes(*first),
            again == nullptr ? "" : "; measured again, it " + takes(*again));
    }
    return standing;
}

void sayBroken(const suite::FolderComparison& comparison) {
    for (const suite::FolderCell* cell : comparison.broken)
        std::cerr << fmt::format("regression: {}: in B {}\n", suite::labelOf(*cell, comparison.axes),
                                 files::printable(suite::whyBroken(*cell)));
}

void writeMarkdown(const RegressionOptions& options, const suite::FolderComparison& comparison,
                   const std::vector<Alert>& regressions) {
    if (options.markdown.empty()) return;
    exports::writeWhole(
        options.markdown,
        suite::comparisonMarkdown(comparison, options.a, options.b, [&](const suite::EvaluatedCell& evaluated) {
            return std::ranges::any_of(regressions, [&](const Alert& alert) {
                return alert.cell == evaluated.cell && alert.column == evaluated.column;
            });
        }));
    std::cout << options.markdown << "\n";
}

/// Measures alerts again; returns the confirmed ones, or nothing if aborted.
std::optional<std::vector<Alert>> lookAgain(const RegressionOptions& options, const suite::ResultsSide& a,
                                            const suite::FolderComparison& comparison,
                                            const std::vector<Alert>& alerts) {
    const results::TemporaryFolder temporary;
    const std::filesystem::path folder =
        options.out.empty() ? temporary.path() / "again" : std::filesystem::path(options.out) / "again";
    const SecondLook second(a, comparison, alerts, *options.failPercent, folder);
    if (second.aborted()) return std::nullopt;
    if (!second.whyNot().empty())
        std::cerr << fmt::format("note: not measured again: {}\n", files::printable(second.whyNot()));
    return confirmed(comparison, alerts, second);
}

/// Comparing results with themselves would always pass.
void requireTwoFolders(const std::string& a, const std::string& b) {
    std::error_code none;
    if (std::filesystem::equivalent(a, b, none) ||
        std::filesystem::equivalent(std::filesystem::path(a) / "runs", std::filesystem::path(b) / "runs", none))
        throw InputError(
            fmt::format("compare: '{}' and '{}' are the same folder, expected two different folders", a, b));
}

}  // namespace

int checkRegression(const RegressionOptions& options) {
    const std::vector<std::string> columns = parseColumns(options.columns);
    requireTwoFolders(options.a, options.b);
    const suite::ResultsSide a{options.a, results::readStoredRuns(options.a)};
    const suite::ResultsSide b{options.b, results::readStoredRuns(options.b)};
    for (const suite::ResultsSide* side : {&a, &b})
        if (const std::string said = results::saysNothingOfOutputs(side->runs); !said.empty())
            std::cerr << fmt::format("warning: '{}': {}\n", files::printable(side->name), said);
    const suite::FolderComparison comparison = suite::compareFolders(a, b, columns, options.acrossMachines);
    for (const std::string& remark : comparison.remarks) std::cerr << "note: " << files::printable(remark) << "\n";
    for (const std::string& obstacle : comparison.obstacles)
        std::cerr << "not comparable: " << files::printable(obstacle) << "\n";
    if (!comparison.obstacles.empty()) return exitNotComparable;

    std::cout << fmt::format(
        "B = {} against A = {}: ratio of times, 95 % interval over runs that were not interleaved\n", options.b,
        options.a);
    suite::TextRows table = suite::tabulate(comparison);
    table.rows.insert(table.rows.begin(), std::move(table.header));
    std::cout << textTable(table.rows);
    if (!options.out.empty()) writeCsv(options.out, suite::comparisonCsv(comparison, options.failPercent));
    std::vector<Alert> regressions;
    if (options.failPercent)
        if (const std::vector<Alert> alerts = alertsOf(comparison, *options.failPercent); !alerts.empty()) {
            const auto standing = lookAgain(options, a, comparison, alerts);
            if (!standing) return exitAborted;
            regressions = *standing;
        }
    writeMarkdown(options, comparison, regressions);
    if (!options.failPercent) return exitOk;
    sayBroken(comparison);
    if (!regressions.empty() || !comparison.broken.empty()) return exitRegression;
    // If no regression can be detected, the check must not pass.
    if (std::ranges::none_of(comparison.evaluated,
                             [](const auto& evaluated) { return evaluated.result.hasEnough(); })) {
        std::cerr << fmt::format(
            "not comparable: no configuration has {} timed runs in both folders, so no regression can be detected\n",
            measure::minimumTimes);
        return exitNotComparable;
    }
    return exitOk;
}

}  // namespace dustbench::cli
