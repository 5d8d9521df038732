// How long a run will take, found out by beginning it: its start and its preroll as they are, then a few of its frames
// and one of each kind that its metrics need, each counted as often as the whole run does it.
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

/// What a begun pass of frames took.
struct FramesBegun {
    double untilFrames = 0;  ///< start and preroll
    double perFrame = 0;
};
/// What a begun pass of metrics took.
struct MetricsBegun {
    double untilFrames = 0;      ///< start and preroll
    double perPlainFrame = 0;    ///< one that is only gone through
    double perMoment = 0;        ///< one that is judged by itself
    double perStretchFrame = 0;  ///< one of the stretch that popping is found in
};
/// The whole run's time.
[[nodiscard]] RunForecast extrapolate(const RunSpec& spec, const FramesBegun& frames, const MetricsBegun& metrics);

/// Begins the run, in a process that is its own; what it leaves in `folder` is of no use. Throws as measureRun does.
[[nodiscard]] RunForecast forecastRun(const RunSpec& spec, const std::filesystem::path& folder);

}  // namespace dustbench::bench
