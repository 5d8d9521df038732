#include "bench/cli/plan_runner.h"

#include <algorithm>
#include <iostream>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/interruption.h"
#include "bench/cli/progress_printer.h"
#include "bench/measure/provenance.h"
#include "methods/shared/gpu/device.h"

namespace dustbench::cli {

bench::ExecutionOptions childExecution() {
    listenForInterruption();
    bench::ExecutionOptions execution;
    execution.argv = bench::commandLine();
    execution.interrupted = [] { return interrupted(); };
    execution.command = [argv = execution.argv](const std::filesystem::path& spec,
                                                const std::filesystem::path& folder) {
        std::vector<std::string> command{"/proc/self/exe", childCommandName, spec.string(), folder.string(), "--"};
        command.insert(command.end(), argv.begin(), argv.end());
        return command;
    };
    return execution;
}

int runPlan(const std::vector<bench::PlannedRun>& plan, int repetitions, bench::ResultsFolder& results,
            const PlanOptions& options) {
    { const gpu::Device mustExist; }
    bench::ExecutionOptions execution = childExecution();
    execution.force = options.force;
    execution.retryFailed = options.retryFailed;
    execution.redoOutdated = options.redoOutdated;
    execution.timeoutSeconds = options.timeoutSeconds;
    execution.cooldownSeconds = options.cooldownSeconds;
    execution.badInputEnds = options.badInputEnds;
    for (const std::string& sentence : results.setAside()) std::cerr << "warning: " << sentence << std::endl;
    ProgressPrinter printer;
    const bench::ExecutionResult result = bench::execute(plan, repetitions, results, execution, printer);
    if (result.aborted) {
        std::cerr << "aborted; the same command goes on from here" << std::endl;
        return exitAborted;
    }
    if (plan.size() > 1)
        std::cerr << result.done << " done, " << result.skipped << " skipped, " << result.failed << " failed, "
                  << result.kept << " were there" << std::endl;
    if (result.outdated > 0)
        std::cerr << "outdated: " << result.outdated << " of those that were there; --redo-outdated does them again ("
                  << result.whyOutdated << ")" << std::endl;
    return result.failed > 0 ? exitRunFailed : exitOk;
}

}  // namespace dustbench::cli
