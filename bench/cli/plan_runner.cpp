#include "bench/cli/plan_runner.h"

#include <algorithm>
#include <iostream>
#include <thread>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/interruption.h"
#include "bench/cli/progress_printer.h"
#include "bench/measure/provenance.h"
#include "bench/results/stored_run.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::cli {

bench::ExecutionOptions childExecution() {
    listenForInterruption();
    bench::ExecutionOptions execution;
    execution.argv = bench::commandLine();
    execution.interrupted = [] { return interrupted(); };
    const auto calling = [argv = execution.argv](const char* name) -> bench::ChildCommandLine {
        return [argv, name](const std::filesystem::path& spec, const std::filesystem::path& folder) {
            std::vector<std::string> command{"/proc/self/exe", name, spec.string(), folder.string(), "--"};
            command.insert(command.end(), argv.begin(), argv.end());
            return command;
        };
    };
    execution.command = calling(measureRunName);
    execution.forecastCommand = calling(forecastRunName);
    return execution;
}

namespace {

/// Number of simultaneous runs: one if any run's times are measured, otherwise one per core.
int simultaneousOf(const std::vector<bench::PlannedRun>& plan) {
    const bool isTimed = std::ranges::any_of(plan, [](const bench::PlannedRun& run) { return run.spec.timed; });
    return isTimed ? 1 : static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
}

bench::ExecutionOptions executionOf(const std::vector<bench::PlannedRun>& plan, const PlanOptions& options) {
    bench::ExecutionOptions execution = childExecution();
    execution.simultaneous = simultaneousOf(plan);
    execution.force = options.force;
    execution.retryFailed = options.retryFailed;
    execution.redoOutdated = options.redoOutdated;
    execution.timeoutSeconds = options.timeoutSeconds;
    execution.limits = options.limits;
    execution.cooldownSeconds = options.cooldownSeconds;
    execution.badInputEnds = options.badInputEnds;
    execution.forecasts = options.forecasts;
    return execution;
}

}  // namespace

void requireOpenGl() {
    const gpu::Device mustExist;
}

bench::PlanForecast forecastRuns(const std::vector<bench::PlannedRun>& plan, bench::ResultsFolder& results,
                                 PlanOptions& options) {
    bench::ExecutionOptions execution = executionOf(plan, options);
    ProgressPrinter printer;
    bench::PlanForecast forecast = bench::forecastPlan(plan, results, execution, printer);
    printer.eraseBar();
    options.forecasts = std::move(execution.forecasts);
    return forecast;
}

int runPlan(const std::vector<bench::PlannedRun>& plan, int repetitions, bench::ResultsFolder& results,
            const PlanOptions& options) {
    const bench::ExecutionOptions execution = executionOf(plan, options);
    for (const std::string& sentence : results.setAside())
        std::cerr << "warning: " << files::printable(sentence) << std::endl;
    if (const std::string said = bench::saysNothingOfOutputs(results.runs()); !said.empty())
        std::cerr << "warning: " << said << std::endl;
    ProgressPrinter printer(execution.simultaneous == 1);
    const bench::ExecutionResult result = bench::execute(plan, repetitions, results, execution, printer);
    if (result.aborted) {
        std::cerr << "aborted; repeat the command to resume" << std::endl;
        return exitAborted;
    }
    if (plan.size() > 1)
        std::cerr << result.done << " done, " << result.skipped << " skipped, " << result.failed << " failed, "
                  << result.kept << " existing" << std::endl;
    else if (result.kept > 0)
        std::cerr << "the result already exists; --force measures it again" << std::endl;
    if (result.outdated > 0)
        std::cerr << "outdated: " << result.outdated << " of the existing results; --redo-outdated re-runs them ("
                  << files::printable(result.whyOutdated) << ")" << std::endl;
    return result.failed > 0 ? exitRunFailed : exitOk;
}

}  // namespace dustbench::cli
