// What `run`, `suite` and `reproduce` share: working through a plan with progress, Ctrl-C and exit codes.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/run/executor.h"
#include "bench/run/plan_forecast.h"

namespace dustbench::cli {

/// The options of executing that a user may set; the rest is filled in.
struct PlanOptions {
    bool force = false;
    bool retryFailed = false;
    bool redoOutdated = false;
    double timeoutSeconds = 0;
    double cooldownSeconds = 0;
    bool badInputEnds = false;
    bench::ForecastByCell forecasts{};
};

/// How this program runs one process a run, for provenance with the user's command; Ctrl-C ends it.
[[nodiscard]] bench::ExecutionOptions childExecution();

/// Throws InputError where there is no OpenGL to draw with, or not the adapter that is asked for. Called before a
/// folder for results is made.
void requireOpenGl();

/// Begins each cell of what is left to do and fills in `options.forecasts`. Throws InputError.
[[nodiscard]] bench::PlanForecast forecastRuns(const std::vector<bench::PlannedRun>& plan,
                                               bench::ResultsFolder& results, PlanOptions& options);

/// Executes and gives the exit code. Throws InputError.
[[nodiscard]] int runPlan(const std::vector<bench::PlannedRun>& plan, int repetitions, bench::ResultsFolder& results,
                          const PlanOptions& options);

}  // namespace dustbench::cli
