// Forecasts the duration of a plan by starting one run of each configuration (run_forecast.h) in its own process.
//
// Threads: call from the main thread.
#pragma once

#include <string>
#include <vector>

#include "bench/run/executor.h"

namespace dustbench::run {

struct PlanForecast {
    std::size_t runs = 0;  ///< runs still to do
    double seconds = 0;    ///< total, including the pauses between them
    /// A sentence for each configuration that failed to start or will probably exceed the time limit.
    std::vector<std::string> warnings{};
    bool aborted = false;
};

/// Sets `options.forecasts` for all runs to do; the listener hears `begun 3 48`.
[[nodiscard]] PlanForecast forecastPlan(const std::vector<suite::PlannedRun>& plan, results::ResultsFolder& results,
                                        ExecutionOptions& options, ExecutionListener& listener);

}  // namespace dustbench::run
