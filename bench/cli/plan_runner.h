// Executes a plan with progress output, Ctrl-C handling and exit codes, for `run`, `suite`, `reproduce` and others.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/executor.h"
#include "bench/run/plan_forecast.h"

namespace dustbench::cli {

/// The execution options that a user can set.
struct PlanOptions {
    bool force = false;
    bool retryFailed = false;
    bool redoOutdated = false;
    double timeoutSeconds = 0;
    suite::ResourceLimits limits{};
    double cooldownSeconds = 0;
    bool badInputEnds = false;
    run::ForecastByCell forecasts{};
};

/// Options that execute each run in a process of this program, record the user's command as provenance, and stop on
/// Ctrl-C.
[[nodiscard]] run::ExecutionOptions childExecution();

/// Throws InputError if OpenGL or the requested adapter is not available. Call before creating a results folder.
void requireOpenGl();

/// Starts a run of each remaining configuration and fills in `options.forecasts`. Throws InputError.
[[nodiscard]] run::PlanForecast forecastRuns(const std::vector<suite::PlannedRun>& plan,
                                             results::ResultsFolder& results, PlanOptions& options);

/// Executes the plan and returns the exit code. Throws InputError.
[[nodiscard]] int runPlan(const std::vector<suite::PlannedRun>& plan, int repetitions, results::ResultsFolder& results,
                          const PlanOptions& options);

/// Shows the progress of a plan on stderr: a bar on a terminal, plain lines elsewhere.
class ProgressPrinter : public run::ExecutionListener {
 public:
    /// `showsSteps`: show the progress within a run, if only one runs at a time.
    explicit ProgressPrinter(bool showsSteps = true);

    void started(std::size_t position, std::size_t total, const suite::PlannedRun& run, int repetitions,
                 double etaSeconds) override;
    void progressed(std::string_view line) override;
    void ended(const suite::PlannedRun& run, results::RunStatus status, const std::string& reason) override;
    /// Call before printing anything else.
    void eraseBar();

 private:
    [[nodiscard]] int terminalWidth() const;
    [[nodiscard]] double phaseSeconds(std::chrono::steady_clock::time_point now) const;

    bool terminal_, showsSteps_;
    std::string last_;                                  ///< the run's last message
    std::chrono::steady_clock::time_point phaseStart_;  ///< start of the run's current phase
    std::chrono::steady_clock::time_point lastShown_;
};

// --- Interruption

/// After this call, Ctrl-C, `kill` and a closed terminal only set a flag to poll, so that results are never left
/// incomplete.
void listenForInterruption();
[[nodiscard]] bool interrupted();

/// During its lifetime, these signals end the program immediately with exitAborted. For work that cannot poll and
/// writes nothing.
class EndsWhenInterrupted {
 public:
    EndsWhenInterrupted();
    ~EndsWhenInterrupted() { listenForInterruption(); }
    EndsWhenInterrupted(const EndsWhenInterrupted&) = delete;
    EndsWhenInterrupted& operator=(const EndsWhenInterrupted&) = delete;
};

}  // namespace dustbench::cli
