// How long a list of runs will still take: from those that have ended, and from what was known before.
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
    /// The runs still to do, in order, with a rest before each but the first.
    explicit RemainingTime(const std::vector<const PlannedRun*>& toDo, const ForecastByCell& forecasts = {},
                           double cooldownSeconds = 0);

    /// The next of them took so long, with the rest before it.
    void ended(double seconds);
    /// Of all that is left: a run counts as long as the other repetitions of its cell did; the first of a cell as long
    /// as its forecast, or without one as all others on average. Negative while nothing is known of some run.
    [[nodiscard]] double seconds() const;

 private:
    struct Ended {
        double sum = 0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
    };
    struct Run {
        std::string cell;     ///< what its repetitions have in common
        double forecast = 0;  ///< with the rest before it; negative: none
    };
    std::vector<Run> runs_;
    std::size_t next_ = 0;
    std::map<std::string, Ended> byCell_;
    Ended all_;
};

}  // namespace dustbench::bench
