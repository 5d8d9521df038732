// Works through a plan of runs, one process each, and keeps what comes out of them.
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
#include "bench/run/forecast_by_cell.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

/// Hears how a plan goes on. All members do nothing unless overridden.
class ExecutionListener {
 public:
    virtual ~ExecutionListener() = default;
    /// `position` counts from 1 among the `total` runs of the plan; `etaSeconds` is negative while nothing is known.
    virtual void started(std::size_t /*position*/, std::size_t /*total*/, const PlannedRun& /*run*/,
                         int /*repetitions*/, double /*etaSeconds*/) {}
    /// What the run says of itself: `frames 12 120`; empty about once a second where it says nothing.
    virtual void heard(std::string_view /*line*/) {}
    virtual void ended(const PlannedRun& /*run*/, RunStatus /*status*/, const std::string& /*reason*/) {}
};

using ChildCommandLine =
    std::function<std::vector<std::string>(const std::filesystem::path& spec, const std::filesystem::path& folder)>;

struct ExecutionOptions {
    bool force = false;         ///< do again what is there
    bool retryFailed = false;   ///< do again what failed or ran out of time
    bool redoOutdated = false;  ///< do again what another build measured, or whose input files have changed
    double timeoutSeconds = 0;
    double cooldownSeconds = 0;     ///< of rest before each run but the first
    std::vector<std::string> argv;  ///< the user's command, for provenance
    /// The command that measures one run: it reads the specification and leaves a run's files in the folder.
    ChildCommandLine command;
    /// The same, but the run is only begun; it says on stdout what the whole of it will take (plan_forecast.h).
    ChildCommandLine forecastCommand;
    /// What is known before the first run.
    ForecastByCell forecasts;
    std::function<bool()> interrupted;
    /// Exit code 3 of a run is the user's mistake: nothing is kept and InputError is thrown with the run's last words.
    bool badInputEnds = false;
};

struct ExecutionResult {
    std::size_t done = 0;
    std::size_t skipped = 0;
    std::size_t failed = 0;     ///< and timeouts; those of an earlier time count as well where they were left alone
    std::size_t kept = 0;       ///< were there before
    std::size_t outdated = 0;   ///< of those: what another build measured, or whose input files have changed
    std::string whyOutdated{};  ///< the first of them
    bool aborted = false;
};

/// The parts of the plan that `execute` would do, in order.
[[nodiscard]] std::vector<const PlannedRun*> runsToDo(const std::vector<PlannedRun>& plan, const ResultsFolder& results,
                                                      const ExecutionOptions& options);

/// Throws InputError where the disk is full or the folder cannot be written any more: nothing finished is lost, and the
/// same call goes on once that is mended.
[[nodiscard]] ExecutionResult execute(const std::vector<PlannedRun>& plan, int repetitions, ResultsFolder& results,
                                      const ExecutionOptions& options, ExecutionListener& listener);

}  // namespace dustbench::bench
