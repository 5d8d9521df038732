// The metrics of a run: a row of metrics.csv for each frame with metrics, and columns of summary.csv.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/reference/judge/moment_metrics.h"

namespace dustbench::bench {

/// Metrics of one run; frames ascending.
struct RunMetrics {
    std::vector<MomentMetrics> frames;  ///< moments, and the consecutive frames for popping, which have only popping
    MetricValues ofRun{};               ///< those of pairs of frames
};

/// `frame,time_s,` and every metric with values of frames.
[[nodiscard]] std::string metricsCsv(const RunMetrics& runMetrics);

/// Means over the moments at which a metric is defined, by column of summary.csv; `identical` is 1 if all moments are
/// identical. Metrics that are never defined are omitted.
[[nodiscard]] std::vector<std::pair<std::string, double>> summaryOf(const RunMetrics& runMetrics);

/// A warning if the mean of `volume_picture` (bench/measure/image/volume_error.h) shows that the method draws other
/// volumes than it reports; else empty.
[[nodiscard]] std::string volumeWarning(const RunMetrics& runMetrics);

}  // namespace dustbench::bench
