// Forecasts the duration of a run by starting it: measures its start and preroll, a few frames, and one frame of each
// kind that its metrics need, each multiplied by its number in the complete run.
//
// Units: seconds.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/results/run_spec.h"

namespace dustbench::bench {

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
/// The time of the complete run.
[[nodiscard]] RunForecast extrapolate(const RunSpec& spec, const FramesBegun& frames, const MetricsBegun& metrics);

/// Starts the run in this process, which must do nothing else. Discard the files in `folder`. Throws as measureRun
/// does.
[[nodiscard]] RunForecast forecastRun(const RunSpec& spec, const std::filesystem::path& folder);

}  // namespace dustbench::bench
