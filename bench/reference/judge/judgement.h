// What a run's metrics come to: its row of metrics.csv for each judged frame, and its cells of summary.csv.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/reference/judge/moment_metrics.h"

namespace dustbench::bench {

/// Of one run; frames rise.
struct Judgement {
    std::vector<MomentMetrics> frames;  ///< judged moments, and those of the popping stretch, which have that alone
    std::optional<double> popping, poppingMax;
};

/// `frame,time_s,` and every metric.
[[nodiscard]] std::string metricsCsv(const Judgement& judgement);

/// Means over the moments at which a metric is defined, by column of summary.csv; `identical` is 1 where all moments
/// are. A metric that is defined at none is left out.
[[nodiscard]] std::vector<std::pair<std::string, double>> summaryOf(const Judgement& judgement);

struct MetricInfo {
    std::string_view column;  ///< of summary.csv
    std::string_view title;   ///< a line
};
/// All metrics in order. reports/METRICS.md defines them.
[[nodiscard]] std::span<const MetricInfo> metricInfos();

}  // namespace dustbench::bench
