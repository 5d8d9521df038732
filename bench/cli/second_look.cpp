#include "bench/cli/second_look.h"

#include <algorithm>

#include "bench/cli/exit_codes.h"
#include "bench/cli/plan_runner.h"
#include "bench/results/compared_runs.h"
#include "bench/results/freshness.h"

namespace dustbench::cli {
namespace {

/// The configurations to measure: those that alert, or all of them if their mean alerts.
std::vector<const bench::FolderCell*> cellsOf(const bench::FolderComparison& first, const std::vector<Alert>& alerts) {
    const bool ofAll = std::ranges::any_of(alerts, [](const Alert& alert) { return alert.cell == nullptr; });
    std::vector<const bench::FolderCell*> cells;
    for (const bench::FolderCell& cell : first.cells) {
        const bool alerting = std::ranges::any_of(alerts, [&](const Alert& alert) { return alert.cell == &cell; });
        if (!cell.a.done.empty() && !cell.b.done.empty() && (ofAll || alerting)) cells.push_back(&cell);
    }
    return cells;
}

/// Plans one repetition of all configurations after the other, as a suite does.
std::vector<bench::PlannedRun> planOf(const std::vector<const bench::FolderCell*>& cells, int& repetitions) {
    std::vector<bench::PlannedRun> plan;
    repetitions = 0;
    for (const bench::FolderCell* cell : cells)
        repetitions = std::max(repetitions, static_cast<int>(cell->b.done.size()));
    for (int repetition = 1; repetition <= repetitions; ++repetition)
        for (const bench::FolderCell* cell : cells)
            if (repetition <= static_cast<int>(cell->b.done.size())) {
                bench::PlannedRun& run = plan.emplace_back();
                run.spec = bench::inRepetition(bench::specFromKey(*cell->b.done.front()), repetition);
            }
    return plan;
}

}  // namespace

SecondLook::SecondLook(const bench::ResultsSide& a, const bench::FolderComparison& first,
                       const std::vector<Alert>& alerts, double percent, const std::filesystem::path& folder)
    : percent_(percent), a_{a.name, {}} {
    const std::vector<const bench::FolderCell*> cells = cellsOf(first, alerts);
    bench::Freshness freshness;
    for (const bench::FolderCell* cell : cells) {
        for (const bench::StoredRun* run : cell->b.done)
            if (whyNot_.empty()) whyNot_ = freshness.whyOutdated(*run);
        for (const bench::StoredRun* run : cell->a.done) a_.runs.emplace(run->runId, *run);
    }
    if (cells.empty()) whyNot_ = "no configuration is complete in both folders";
    if (!whyNot_.empty()) return;

    int repetitions = 0;
    const std::vector<bench::PlannedRun> plan = planOf(cells, repetitions);
    requireOpenGl();
    bench::ResultsFolder results(folder);
    PlanOptions options;
    options.force = true;
    aborted_ = runPlan(plan, repetitions, results, options) == exitAborted;
    b_ = {folder.string(), results.runs()};
    std::set<std::string> columns;
    for (const Alert& alert : alerts) columns.insert(alert.column);
    comparison_ = bench::compareFolders(a_, b_, {columns.begin(), columns.end()}, false);
    if (!comparison_.obstacles.empty()) whyNot_ = comparison_.obstacles.front();
}

const bench::EvaluatedCell* SecondLook::evaluated(const Alert& alert) const {
    for (const bench::EvaluatedCell& evaluated : comparison_.evaluated) {
        const bool isIt = alert.cell == nullptr
                              ? evaluated.cell == nullptr
                              : evaluated.cell != nullptr && evaluated.cell->identity == alert.cell->identity;
        if (isIt && evaluated.column == alert.column) return &evaluated;
    }
    return nullptr;
}

bool SecondLook::confirms(const Alert& alert) const {
    const bench::EvaluatedCell* again = evaluated(alert);
    return again == nullptr || !again->result.hasEnough() || bench::isSlowerBy(*again, percent_);
}

}  // namespace dustbench::cli
