// What is known before of how long runs take, cell by cell.
//
// Units: seconds.
#pragma once

#include <map>
#include <string>

#include "bench/results/run_spec.h"
#include "bench/run/run_forecast.h"

namespace dustbench::bench {

/// What all repetitions of a cell have in common; the first alone is judged.
[[nodiscard]] std::string cellOf(RunSpec run);

class ForecastByCell {
 public:
    /// Of all repetitions of a cell.
    void set(const RunSpec& cell, const RunForecast& forecast);
    /// The metrics count only where the run has them. Negative where nothing is known.
    [[nodiscard]] double seconds(const RunSpec& run) const;

 private:
    std::map<std::string, RunForecast> byCell_;
};

}  // namespace dustbench::bench
