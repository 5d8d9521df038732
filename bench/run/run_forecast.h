// Forecasts the duration of a run by starting it: its real start and preroll, then a few frames and one of each kind
// that its metrics need, each scaled by how often it occurs in the whole run.
//
// Units: seconds.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/results/run_spec.h"

namespace dustbench::bench {

struct RunForecast {
    double measuring = 0;  ///< from the start of the process to the last frame
    double judging = 0;    ///< the metrics after it
    [[nodiscard]] double seconds() const { return measuring + judging; }
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
    double perMoment = 0;        ///< a frame that is judged individually
    double perStretchFrame = 0;  ///< a frame of the stretch for popping
};
/// The whole run's time.
[[nodiscard]] RunForecast extrapolate(const RunSpec& spec, const FramesBegun& frames, const MetricsBegun& metrics);

/// Starts the run in this process, which must not be used for anything else; the files in `folder` are to be discarded.
/// Throws as measureRun does.
[[nodiscard]] RunForecast forecastRun(const RunSpec& spec, const std::filesystem::path& folder);

}  // namespace dustbench::bench
