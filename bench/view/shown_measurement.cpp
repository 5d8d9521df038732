#include "bench/view/shown_measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/measure/statistics.h"
#include "bench/results/compared_runs.h"
#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_evaluation.h"
#include "methods/contract/errors.h"

namespace dustbench::view {
namespace {

suite::PlannedRun cellOf(const ViewState& state, Half half) {
    suite::PlannedRun cell{runOf(state, half), half == Half::a ? "A" : "B"};
    cell.spec.frames = std::max(cell.spec.frames, minimumMeasuredFrames);
    cell.spec.warmup = std::max(cell.spec.warmup, results::RunSpec().warmup);
    cell.spec.imagesEvery = 0;
    results::requireChangesWithinRun(cell.spec);
    return cell;
}

suite::ComparedSide sideOf(const suite::PlannedRun& cell) {
    return {cell.spec.method, cell.spec.parameters, cell.label + " (" + cell.spec.method + ")"};
}

/// Reports the progress of the runs, and lets the window draw between them.
class ProgressReporter : public run::ExecutionListener {
 public:
    explicit ProgressReporter(const MeasurementHooks& hooks) : hooks_(hooks) {}

    void started(std::size_t position, std::size_t total, const suite::PlannedRun& run, int repetitions,
                 double eta) override {
        std::string progress = fmt::format("measuring: run {} of {}, {}, repetition {} of {}", position, total,
                                           run.spec.method, run.spec.repetition, repetitions);
        if (eta >= 0) progress += fmt::format(", about {:.0f} s left", eta);
        if (hooks_.between) hooks_.between(progress + "; Escape cancels");
    }
    void ended(const suite::PlannedRun& run, results::RunStatus status, const std::string& reason) override {
        if (status != results::RunStatus::done && whyNot_.empty())
            whyNot_ = fmt::format("{}: {}", run.spec.method, reason);
    }
    /// Why the first failed run failed; empty if none did.
    [[nodiscard]] const std::string& whyNot() const { return whyNot_; }

 private:
    const MeasurementHooks& hooks_;
    std::string whyNot_;
};

std::string timesOf(const suite::PlannedRun& cell, const suite::Suite& suite, const results::StoredRuns& runs) {
    const auto done = suite::doneRuns(cell, suite.repetitions, runs);
    const auto times = suite::numbersIn(done, "frame_ms_median");
    if (times.empty()) return fmt::format("{}: no times measured", sideOf(cell).label);
    const std::string invalid = results::saysInvalid(done);
    return fmt::format("frame_ms_median: {} takes {:.3f} ms, {:.3f} to {:.3f} in {} runs{}{}", sideOf(cell).label,
                       measure::median(times), measure::minimum(times), measure::maximum(times), times.size(),
                       invalid.empty() ? "" : "; ", invalid);
}

}  // namespace

suite::Suite measurementOf(const ViewState& state) {
    suite::Suite suite;
    suite.id = "view";
    suite.title = "Measurement from the window";
    suite.repetitions = measuredRepetitions;
    suite.baseline = true;
    suite.cells.push_back(cellOf(state, Half::a));
    if (!state.b || showsExact(state)) return suite;
    suite.cells.push_back(cellOf(state, Half::b));
    if (results::runId(suite.cells[0].spec) == results::runId(suite.cells[1].spec))
        throw InputError("measure: A and B are the same run, expected methods or parameters that differ");
    suite::PlannedComparison comparison{sideOf(suite.cells[1]), sideOf(suite.cells[0]), {"frame_ms_median"}, ""};
    if (std::ranges::none_of(suite.cells,
                             [](const suite::PlannedRun& cell) { return cell.spec.method == results::baselineMethod; }))
        comparison.columns.emplace_back("method_ms_median");
    suite.comparisons.push_back(std::move(comparison));
    return suite;
}

std::vector<std::string> measure(const suite::Suite& suite, const std::filesystem::path& folder,
                                 const MeasurementHooks& hooks) {
    results::ResultsFolder results(folder);
    run::ExecutionOptions execution = hooks.execution;
    execution.force = true;
    execution.timeoutSeconds = suite.timeoutSeconds;
    execution.interrupted = [&] {
        return (hooks.cancelled && hooks.cancelled()) || (hooks.execution.interrupted && hooks.execution.interrupted());
    };
    ProgressReporter reporter(hooks);
    const auto plan = suite::planRuns(suite);
    const run::ExecutionResult result = run::execute(plan, suite.repetitions, results, execution, reporter);
    if (result.aborted)
        return {fmt::format("measurement cancelled after {} of {} runs", result.done + result.skipped + result.failed,
                            plan.size())};
    std::vector<std::string> sentences(suite.cells.size());
    std::ranges::transform(suite.cells, sentences.begin(),
                           [&](const suite::PlannedRun& cell) { return timesOf(cell, suite, results.runs()); });
    for (const suite::ComparisonResult& comparison : suite::suiteVerdicts(suite, results.runs()))
        for (std::string& sentence : suite::conclusions(comparison)) sentences.push_back(std::move(sentence));
    if (!reporter.whyNot().empty()) sentences.push_back(reporter.whyNot());
    sentences.push_back("results: " + folder.string());
    return sentences;
}

}  // namespace dustbench::view
