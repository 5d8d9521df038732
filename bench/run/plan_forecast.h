// How long a plan will take, from a beginning of each of its cells (run_forecast.h) in a process of its own.
//
// Threads: call from the main thread.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/run/executor.h"

namespace dustbench::bench {

struct PlanForecast {
    std::size_t runs = 0;  ///< that are left to do
    double seconds = 0;    ///< of all of them, with the rest between them
    /// A sentence for each cell that failed when it was begun, or will take longer than it may.
    std::vector<std::string> warnings{};
    bool aborted = false;
};

/// What a begun run's process says on stdout, and what is read there.
[[nodiscard]] std::string forecastLine(const RunForecast& forecast);

/// Fills in `options.forecasts` for all that is left to do; the listener hears `begun 3 48`.
[[nodiscard]] PlanForecast forecastPlan(const std::vector<PlannedRun>& plan, ResultsFolder& results,
                                        ExecutionOptions& options, ExecutionListener& listener);

}  // namespace dustbench::bench
