// Forecasts of the duration of runs, by configuration (cell).
//
// Units: seconds.
#pragma once

#include <map>
#include <string>

#include "bench/results/run_spec.h"
#include "bench/run/run_forecast.h"

namespace dustbench::bench {

/// Identifies the configuration of a run: equal for all repetitions and seeds, with and without metrics. Another seed
/// gives another cloud of the same size.
[[nodiscard]] std::string cellOf(RunSpec run);

class ForecastByCell {
 public:
    /// Sets the forecast for all repetitions and seeds of a configuration.
    void set(const RunSpec& cell, const RunForecast& forecast);
    /// Includes the metrics only if the run has them. Negative if unknown.
    [[nodiscard]] double seconds(const RunSpec& run) const;

 private:
    std::map<std::string, RunForecast> byCell_;
};

}  // namespace dustbench::bench
