// Estimates the remaining time of a list of runs, from finished runs and forecasts.
//
// Units: seconds.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bench/run/forecast_by_cell.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

class RemainingTime {
 public:
    /// `toDo` are the runs still to do, in order, with a pause before each except the first.
    explicit RemainingTime(const std::vector<const PlannedRun*>& toDo, const ForecastByCell& forecasts = {},
                           double cooldownSeconds = 0);

    /// Records the duration of the run at `position` in the list, including the pause before it.
    void ended(std::size_t position, double seconds);
    /// Total of all remaining runs. The estimate of a run is the mean of the finished repetitions of its configuration;
    /// without any, its forecast; without that, the mean of all finished runs. Negative if a run has no estimate.
    [[nodiscard]] double seconds() const;

 private:
    struct Ended {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    };
    struct Run {
        std::string cell;     ///< identifies the configuration
        double forecast = 0;  ///< including the pause before it; negative: none
        bool ended = false;
    };
    std::vector<Run> runs_;
    std::map<std::string, Ended> byCell_;
    Ended all_;
};

}  // namespace dustbench::bench
