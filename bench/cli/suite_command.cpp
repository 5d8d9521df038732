// `dustbench suite`: runs or resumes a suite.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/plan_runner.h"
#include "bench/cli/shared_options.h"
#include "bench/cli/suite_report.h"
#include "bench/measure/provenance.h"
#include "bench/report/page.h"
#include "bench/results/shell_words.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_plan.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::cli {
namespace {

// --- The Slurm array job of a suite: one task per shard, followed by a job that merges the results

struct SlurmJob {
    std::string name;                    ///< of the suite
    std::string program, folder, out;    ///< absolute; `folder` is the working directory of the command
    std::vector<std::string> arguments;  ///< of `dustbench`, without --out, --slurm and --shard
    int shards = 1;
    std::size_t runs = 0, maximumRunsOfShard = 0;
    double timeoutSeconds = 0;   ///< of one run
    double cooldownSeconds = 0;  ///< between two runs
};

/// Overhead of starting a run, and of a shard. The values are generous, because a task that Slurm kills loses a run,
/// while one that ends early costs nothing.
constexpr double secondsAroundRun = 15, secondsAroundShard = 120;

/// Letters, digits and a few characters without a special meaning for Slurm, which interprets % in file names.
std::string plainName(const std::string& text) {
    std::string plain = text;
    std::ranges::replace_if(
        plain,
        [](char letter) {
            return !std::isalnum(static_cast<unsigned char>(letter)) && letter != '-' && letter != '_' && letter != '.';
        },
        '_');
    return plain;
}

/// `1-02:30:00`
std::string slurmTime(double seconds) {
    const auto minutes = static_cast<long long>(std::ceil(seconds / 60));
    return fmt::format("{}-{:02}:{:02}:00", minutes / (24 * 60), minutes / 60 % 24, minutes % 60);
}

/// A bash script. `sbatch` accepts it as an array job; run directly, it submits itself and the merge job.
std::string slurmScript(const SlurmJob& job) {
    const double around = secondsAroundRun + job.cooldownSeconds;
    const double seconds =
        secondsAroundShard + static_cast<double>(job.maximumRunsOfShard) * (job.timeoutSeconds + around);
    std::string arguments;
    for (const std::string& word : job.arguments) arguments += " " + results::shellQuoted(word);
    const std::filesystem::path file = files::dataPath("templates/slurm.sh");
    if (file.empty()) throw InputError("data: the file templates/slurm.sh is missing");
    return report::filled(files::wholeText(file, "template"), {{"name", plainName(job.name)},
                                                               {"shards", std::to_string(job.shards)},
                                                               {"time", slurmTime(seconds)},
                                                               {"runs", std::to_string(job.runs)},
                                                               {"most", std::to_string(job.maximumRunsOfShard)},
                                                               {"timeout", fmt::format("{:g}", job.timeoutSeconds)},
                                                               {"around", fmt::format("{:g}", around)},
                                                               {"extra", fmt::format("{:g}", secondsAroundShard)},
                                                               {"program", results::shellQuoted(job.program)},
                                                               {"folder", results::shellQuoted(job.folder)},
                                                               {"out", results::shellQuoted(job.out)},
                                                               {"arguments", arguments}});
}

// --- The command

struct SuiteOptions {
    std::string suite, out, order, shard;
    bool quick = false, force = false, retryFailed = false, redoOutdated = false, dryRun = false, estimate = false;
    std::int64_t repetitions = 0, slurmShards = 0;
    double timeoutSeconds = 0;
    double cooldownSeconds = -1;
    VolumeOptions volumes{"--volumes"};
};

/// Prints the Slurm script of the suite. Runs and writes nothing.
int printSlurmScript(const SuiteOptions& options, const suite::Suite& suite, double timeoutSeconds,
                     double cooldownSeconds) {
    if (!options.shard.empty() || options.dryRun || options.estimate)
        throw InputError(fmt::format("--slurm: cannot be combined with {}",
                                     options.dryRun ? "--dry-run" : (options.estimate ? "--estimate" : "--shard")));
    SlurmJob job;
    job.name = suite.id;
    job.program = std::filesystem::read_symlink("/proc/self/exe");
    job.folder = std::filesystem::current_path();
    job.out = std::filesystem::absolute(options.out).lexically_normal();
    std::vector<std::string> words = measure::commandLine();
    words.erase(words.begin());
    job.arguments = withoutOptions(words, {"--out", "--slurm"});
    job.shards = static_cast<int>(options.slurmShards);
    job.timeoutSeconds = timeoutSeconds;
    job.cooldownSeconds = cooldownSeconds;
    const suite::Suite whole = suite::withBaselines(suite);
    std::vector<std::size_t> cells(options.slurmShards + 1, 0);
    for (const int shard : suite::shardOfCells(whole, job.shards)) ++cells[static_cast<std::size_t>(shard)];
    const auto repetitions = static_cast<std::size_t>(suite.repetitions);
    job.runs = whole.cells.size() * repetitions;
    job.maximumRunsOfShard = *std::ranges::max_element(cells) * repetitions;
    if (const auto empty = std::count(cells.begin() + 1, cells.end(), 0U); empty > 0)
        std::cerr << fmt::format("note: {} of {} shards have no runs: runs of one world stay together\n", empty,
                                 job.shards);
    std::cout << slurmScript(job);
    return exitOk;
}

int runSuite(const SuiteOptions& options) {
    suite::Suite suite = suite::loadSuite(options.suite, options.quick);
    if (!options.order.empty()) suite.order = suite::orders.parse("order", options.order);
    if (options.repetitions > 0) suite.repetitions = static_cast<int>(options.repetitions);
    for (suite::PlannedRun& cell : suite.cells) {
        cell.spec.volumes = options.volumes.over(cell.spec.volumes);
        results::requireFramesWithinRun(cell.spec);
    }
    const double timeoutSeconds = options.timeoutSeconds > 0 ? options.timeoutSeconds : suite.timeoutSeconds;
    const double cooldownSeconds = options.cooldownSeconds >= 0 ? options.cooldownSeconds : suite.cooldownSeconds;
    if (options.slurmShards > 0) {
        checkWorlds(suite.cells);
        return printSlurmScript(options, suite, timeoutSeconds, cooldownSeconds);
    }
    const suite::Shard shard = options.shard.empty() ? suite::Shard() : suite::parseShard(options.shard);
    const auto plan = suite::planRuns(suite, shard);
    if (shard.count > 1) suite = suite::partOf(suite, shard);
    if (plan.empty() && shard.count > 1)
        std::cerr << fmt::format("shard {} of {} has no runs: runs of one world stay together\n", options.shard,
                                 suite.id);
    PlanOptions planOptions;
    planOptions.force = options.force;
    planOptions.retryFailed = options.retryFailed;
    planOptions.redoOutdated = options.redoOutdated;
    planOptions.timeoutSeconds = timeoutSeconds;
    planOptions.limits = suite.limits;
    planOptions.cooldownSeconds = cooldownSeconds;
    if (options.dryRun || options.estimate) {
        const auto toDo = printPlan(plan, suite.repetitions, options.out);
        if (options.dryRun && !options.estimate && !toDo.empty())
            std::cerr << "--estimate starts one run of each configuration to estimate how long all runs take\n";
        return options.estimate ? printEstimate(toDo, planOptions) : exitOk;
    }
    checkWorlds(plan);
    if (!plan.empty()) requireOpenGl();
    results::ResultsFolder results(options.out);
    if (plan.empty()) results.writeSummary();
    const int code = plan.empty() ? exitOk : runPlan(plan, suite.repetitions, results, planOptions);
    if (code != exitAborted && !plan.empty()) std::cout << suiteReport(suite, results.runs()) << "\n";
    std::cout << (results.path() / "summary.csv").string() << "\n";
    return code;
}

}  // namespace

Command suiteCommand() {
    auto options = std::make_shared<SuiteOptions>();
    return {"suite", "Run or resume a suite: a list of configurations and repetitions",
            "Existing results are kept. Outdated ones are reported.",
            [options](Arguments& arguments) {
                arguments.required("suite", "", "one of `dustbench list suites`, or a .toml file", options->suite);
                arguments.required("--out", "DIR", "folder for the results; created if missing", options->out);
                arguments.flag("--quick", "run the suite's reduced set of configurations", options->quick);
                arguments.integer("--repetitions",
                                  "runs of every configuration, each in a new process; 0: as the suite specifies",
                                  options->repetitions, 0, files::limits::repetitions);
                arguments.flag("--force", "re-run existing results", options->force);
                arguments.flag("--retry-failed", "re-run runs that failed or timed out", options->retryFailed);
                arguments.flag("--redo-outdated",
                               "re-run results of another build, or whose input files have changed since",
                               options->redoOutdated);
                arguments.text("--order", "interleaved|batch",
                               "repetitions in shuffled rounds over all configurations, or all repetitions of a "
                               "configuration together; default: as the suite specifies",
                               options->order);
                arguments.number("--timeout", "time limit of one run in seconds; 0: as the suite specifies",
                                 options->timeoutSeconds, 0, 1e6);
                arguments.number("--cooldown", "seconds of rest between two runs; below 0: as the suite specifies",
                                 options->cooldownSeconds, -1, 3600);
                options->volumes.declareOptional(arguments);
                arguments.flag("--dry-run", "print the list of runs and their state; run nothing", options->dryRun);
                arguments.flag("--estimate",
                               "print the list, then start one run of each configuration to estimate how long all runs "
                               "take; nothing is kept",
                               options->estimate);
                arguments.text("--shard", "I/N",
                               "run only the I-th of N parts, counted from 1; `dustbench merge` joins their folders",
                               options->shard);
                arguments.integer("--slurm", "print a Slurm script that runs N shards and merges them",
                                  options->slurmShards, 0, suite::maximumShards);
            },
            [options] { return runSuite(*options); }};
}

}  // namespace dustbench::cli
