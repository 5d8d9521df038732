// Executes a plan with progress output, Ctrl-C handling and exit codes, for `run`, `suite`, `reproduce` and others.
#pragma once

#include <filesystem>
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
    bench::ResourceLimits limits{};
    double cooldownSeconds = 0;
    bool badInputEnds = false;
    bench::ForecastByCell forecasts{};
};

/// Options that execute each run in a process of this program, record the user's command as provenance, and stop on
/// Ctrl-C.
[[nodiscard]] bench::ExecutionOptions childExecution();

/// Throws InputError if OpenGL or the requested adapter is not available. Call before creating a results folder.
void requireOpenGl();

/// Starts a run of each remaining configuration and fills in `options.forecasts`. Throws InputError.
[[nodiscard]] bench::PlanForecast forecastRuns(const std::vector<bench::PlannedRun>& plan,
                                               bench::ResultsFolder& results, PlanOptions& options);

/// Executes the plan and returns the exit code. Throws InputError.
[[nodiscard]] int runPlan(const std::vector<bench::PlannedRun>& plan, int repetitions, bench::ResultsFolder& results,
                          const PlanOptions& options);

}  // namespace dustbench::cli
