// Executes a plan of runs, each in its own process, and stores their results.
//
// Threads: call from the main thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/results_folder.h"
#include "bench/results/run_record.h"
#include "bench/run/run_forecast.h"
#include "bench/suite/suite.h"

namespace dustbench::run {

/// Receives progress of a plan. All members do nothing unless overridden.
class ExecutionListener {
 public:
    virtual ~ExecutionListener() = default;
    /// `position` counts from 1 among the `total` runs of the plan; `etaSeconds` is negative if unknown. If runs
    /// overlap, `started` and `ended` are called for each, and `progressed` for any of them.
    virtual void started(std::size_t /*position*/, std::size_t /*total*/, const suite::PlannedRun& /*run*/,
                         int /*repetitions*/, double /*etaSeconds*/) {}
    /// A progress line of the run: `frames 12 120`; empty about once a second while there is no output.
    virtual void progressed(std::string_view /*line*/) {}
    virtual void ended(const suite::PlannedRun& /*run*/, results::RunStatus /*status*/, const std::string& /*reason*/) {
    }
};

using ChildCommandLine =
    std::function<std::vector<std::string>(const std::filesystem::path& spec, const std::filesystem::path& folder)>;

struct ExecutionOptions {
    bool force = false;         ///< re-run existing results
    bool retryFailed = false;   ///< re-run failed and timed-out runs
    bool redoOutdated = false;  ///< re-run results from another build or with changed input files
    double timeoutSeconds = 0;
    suite::ResourceLimits limits;
    double cooldownSeconds = 0;     ///< pause before each run except the first
    int simultaneous = 1;           ///< runs at a time; more than one only if no times are measured
    std::vector<std::string> argv;  ///< the user's command, for provenance
    /// The command that measures one run: reads the specification and writes the run's files into the folder.
    ChildCommandLine command;
    /// The same, but only starts the run and prints a forecast of its duration on stdout (run_messages.h).
    ChildCommandLine forecastCommand;
    /// Forecasts known before the first run.
    ForecastByCell forecasts;
    std::function<bool()> interrupted;
    /// If set, a run that ends for bad input ends the plan: nothing is stored, and InputError is thrown with its
    /// message.
    bool badInputEnds = false;
};

struct ExecutionResult {
    std::size_t done = 0;
    std::size_t skipped = 0;
    std::size_t failed = 0;     ///< including timeouts, and earlier failures that were not retried
    std::size_t kept = 0;       ///< existing results that were kept
    std::size_t outdated = 0;   ///< of these: results from another build or with changed input files
    std::string whyOutdated{};  ///< reason for the first outdated result
    bool aborted = false;
};

/// The runs of the plan that `execute` would run, in order.
[[nodiscard]] std::vector<const suite::PlannedRun*> runsToDo(const std::vector<suite::PlannedRun>& plan,
                                                             const results::ResultsFolder& results,
                                                             const ExecutionOptions& options);

/// Throws files::MachineError if the machine runs out of something (disk space, open files), here or in a run's
/// process, and InputError if the folder is no longer writable. Finished runs are kept, and the same call continues
/// once the problem is solved.
[[nodiscard]] ExecutionResult execute(const std::vector<suite::PlannedRun>& plan, int repetitions,
                                      results::ResultsFolder& results, const ExecutionOptions& options,
                                      ExecutionListener& listener);

}  // namespace dustbench::run
