#include "bench/run/harness_cost.h"

#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::run {

HarnessCost measureHarness(ExecutionOptions options) {
    suite::PlannedRun run;
    run.spec.method = "null_method";
    run.spec.frames = 60;
    run.spec.parameters = results::canonicalParameters(findMethod(run.spec.method), {{"preroll", "0"}});
    options.timeoutSeconds = 60;

    const results::TemporaryFolder folder;
    results::ResultsFolder results(folder.path());
    ExecutionListener untimed;
    (void)execute({run}, 1, results, options, untimed);
    const auto stored = results.runs().find(results::runId(run.spec));
    if (stored == results.runs().end()) throw InputError("the null method was interrupted");
    if (stored->second.status != results::RunStatus::done)
        throw InputError("the null method did not run: " + stored->second.reason);
    const auto number = [&](const char* column) { return std::stod(stored->second.cells.at(column)); };
    return {number("harness_us_median"), number("start_s"), number("frame_ms_median")};
}

}  // namespace dustbench::run
