// Forecasts the duration of a run by starting it, and from that and finished runs the remaining time of a list of runs.
//
// Measured are a run's start and preroll, a few frames, and one frame of each kind that its metrics need. Units:
// seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/suite/suite.h"

namespace dustbench::run {

struct RunForecast {
    double measuring = 0;   ///< from the start of the process to the last frame
    double metricPlan = 0;  ///< the metrics after it
    [[nodiscard]] double seconds() const { return measuring + metricPlan; }
};

/// Timings of a partial pass of frames.
struct FramesBegun {
    double untilFrames = 0;  ///< start and preroll
    double perFrame = 0;
};
/// Timings of a partial pass of metrics.
struct MetricsBegun {
    double untilFrames = 0;      ///< start and preroll
    double perPlainFrame = 0;    ///< a frame that is only replayed
    double perMoment = 0;        ///< a frame with all metrics
    double perStretchFrame = 0;  ///< a frame of the consecutive frames for popping
};
/// The time of the complete run: each timing multiplied by its number in it.
[[nodiscard]] RunForecast extrapolate(const results::RunSpec& spec, const FramesBegun& frames,
                                      const MetricsBegun& metrics);

/// Starts the run in this process, which must do nothing else. Discard the files in `folder`. Throws as measureRun
/// does.
[[nodiscard]] RunForecast forecastRun(const results::RunSpec& spec, const std::filesystem::path& folder);

/// Identifies the configuration of a run: equal for all repetitions and seeds, with and without metrics. Another seed
/// gives another cloud of the same size.
[[nodiscard]] std::string cellOf(results::RunSpec run);

/// The forecasts of a list of runs, by configuration (cell).
class ForecastByCell {
 public:
    /// Sets the forecast for all repetitions and seeds of a configuration.
    void set(const results::RunSpec& cell, const RunForecast& forecast);
    /// Includes the metrics only if the run has them. Negative if unknown.
    [[nodiscard]] double seconds(const results::RunSpec& run) const;

 private:
    std::map<std::string, RunForecast> byCell_;
};

/// Estimates the remaining time of a list of runs, from finished runs and forecasts.
class RemainingTime {
 public:
    /// `toDo` are the runs still to do, in order, with a pause before each except the first.
    explicit RemainingTime(const std::vector<const suite::PlannedRun*>& toDo, const ForecastByCell& forecasts = {},
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

}  // namespace dustbench::run
