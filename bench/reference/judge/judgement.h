// The metrics of a run: a row of metrics.csv for each judged frame, and cells of summary.csv.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/reference/judge/moment_metrics.h"

namespace dustbench::bench {

/// Metrics of one run; frames ascending.
struct Judgement {
    std::vector<MomentMetrics> frames;  ///< judged moments, and frames of the popping stretch, which have only popping
    std::optional<double> popping, poppingMax;
    PoppingBySize poppingBySize{};
};

/// `frame,time_s,` and every metric.
[[nodiscard]] std::string metricsCsv(const Judgement& judgement);

/// Means over the moments at which a metric is defined, by column of summary.csv; `identical` is 1 if all moments are
/// identical. Metrics that are never defined are omitted.
[[nodiscard]] std::vector<std::pair<std::string, double>> summaryOf(const Judgement& judgement);

/// A sentence if the run's pictures are not those of the volumes that the method reported, by the mean of
/// `volume_picture` (bench/measure/image/volume_picture.h); else empty.
[[nodiscard]] std::string volumeWarning(const Judgement& judgement);

struct MetricInfo {
    std::string_view column;  ///< of summary.csv
    std::string_view title;   ///< a one-line description
};
/// All metrics in order. reports/METRICS.md defines them.
[[nodiscard]] std::span<const MetricInfo> metricInfos();

}  // namespace dustbench::bench
