// Shared by `run`, `suite` and `reproduce`: executes a plan with progress output, Ctrl-C handling and exit codes.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/run/executor.h"
#include "bench/run/plan_forecast.h"

namespace dustbench::cli {

/// The execution options that a user can set; the rest is filled in.
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

/// Options to run each run in a process of this program, with the user's command as provenance; Ctrl-C ends it.
[[nodiscard]] bench::ExecutionOptions childExecution();

/// Throws InputError if OpenGL is not available, or not with the requested adapter. Call before creating a results
/// folder.
void requireOpenGl();

/// Starts a run of each cell still to do and fills in `options.forecasts`. Throws InputError.
[[nodiscard]] bench::PlanForecast forecastRuns(const std::vector<bench::PlannedRun>& plan,
                                               bench::ResultsFolder& results, PlanOptions& options);

/// Executes the plan and returns the exit code. Throws InputError.
[[nodiscard]] int runPlan(const std::vector<bench::PlannedRun>& plan, int repetitions, bench::ResultsFolder& results,
                          const PlanOptions& options);

}  // namespace dustbench::cli
