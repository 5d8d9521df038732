// `dustbench suite`: works through a suite, or goes on with it.
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/exit_codes.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/cli/volume_options.h"
#include "bench/run/suite.h"

namespace dustbench::cli {
namespace {

struct SuiteOptions {
    std::string suite, out, order;
    bool quick = false, force = false, retryFailed = false, redoOutdated = false, dryRun = false;
    std::int64_t repetitions = 0;
    double timeoutSeconds = 0;
    double cooldownSeconds = -1;
    VolumeOptions volumes{"--volumes"};
};

int runSuite(const SuiteOptions& options) {
    bench::Suite suite = bench::loadSuite(options.suite, options.quick);
    if (!options.order.empty()) suite.order = bench::parseOrder(options.order);
    if (options.repetitions > 0) suite.repetitions = static_cast<int>(options.repetitions);
    for (bench::PlannedRun& cell : suite.cells) {
        cell.spec.volumes = options.volumes.over(cell.spec.volumes);
        bench::requireFramesWithinRun(cell.spec);
    }
    const auto plan = bench::planRuns(suite);
    if (options.dryRun) {
        for (const bench::PlannedRun& run : plan)
            std::cout << bench::runId(run.spec) << "  " << run.spec.method << " " << run.spec.scene << " " << run.label
                      << (run.label.empty() ? "" : " ") << "rep " << run.spec.repetition << "/" << suite.repetitions
                      << "\n";
        return exitOk;
    }
    checkWorlds(plan);
    bench::ResultsFolder results(options.out);
    PlanOptions planOptions;
    planOptions.force = options.force;
    planOptions.retryFailed = options.retryFailed;
    planOptions.redoOutdated = options.redoOutdated;
    planOptions.cooldownSeconds = options.cooldownSeconds >= 0 ? options.cooldownSeconds : suite.cooldownSeconds;
    planOptions.timeoutSeconds = options.timeoutSeconds > 0 ? options.timeoutSeconds : suite.timeoutSeconds;
    const int code = runPlan(plan, suite.repetitions, results, planOptions);
    if (code != exitAborted) std::cout << suiteReport(suite, results.runs()) << "\n";
    std::cout << (results.path() / "summary.csv").string() << "\n";
    return code;
}

}  // namespace

Command suiteCommand() {
    auto options = std::make_shared<SuiteOptions>();
    return {"suite", "Work through a list of runs, or go on where it was stopped",
            "Runs whose results are there already are left alone; those that are outdated are named.",
            [options](Arguments& arguments) {
                arguments.required("suite", "", "one of `dustbench list suites`, or a .toml file", options->suite);
                arguments.required("--out", "DIR", "folder for the results; made where it is missing", options->out);
                arguments.flag("--quick", "the suite's short form", options->quick);
                arguments.integer("--repetitions", "of every run, each a fresh process; 0: as the suite says",
                                  options->repetitions, 0, 1000);
                arguments.flag("--force", "do again what is there", options->force);
                arguments.flag("--retry-failed", "do again what failed or ran out of time", options->retryFailed);
                arguments.flag("--redo-outdated",
                               "do again what another build measured, or whose input files have changed since",
                               options->redoOutdated);
                arguments.text("--order", "interleaved|batch",
                               "repetitions as shuffled rounds over all runs, or all of a run together; as the suite "
                               "says unless given",
                               options->order);
                arguments.number("--timeout", "seconds that one run may take; 0: as the suite says",
                                 options->timeoutSeconds, 0, 1e6);
                arguments.number("--cooldown", "seconds of rest between two runs; below 0: as the suite says",
                                 options->cooldownSeconds, -1, 3600);
                options->volumes.declareOptional(arguments);
                arguments.flag("--dry-run", "only print the list of runs", options->dryRun);
            },
            [options] { return runSuite(*options); }};
}

}  // namespace dustbench::cli
