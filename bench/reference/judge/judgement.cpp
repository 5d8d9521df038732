#include "bench/reference/judge/judgement.h"

#include <fmt/format.h>

#include "bench/measure/image/volume_error.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

std::optional<double> valueOfRun(const RunMetrics& runMetrics, const Metric& metric) {
    if (metric.overRun == OverRun::pairs || metric.overRun == OverRun::whole) return runMetrics.ofRun.of(metric.column);
    double sum = 0;
    int count = 0;
    for (const MomentMetrics& moment : runMetrics.frames)
        if (const std::optional<double>& value = moment.values.of(metric.column)) {
            sum += *value;
            ++count;
        }
    if (count == 0) return std::nullopt;
    if (metric.overRun == OverRun::all) return sum == count ? 1 : 0;
    return sum / count;
}

}  // namespace

std::string metricsCsv(const RunMetrics& runMetrics) {
    const auto hasFrames = [](const Metric& metric) { return metric.overRun != OverRun::whole; };
    std::string text = "frame,time_s";
    for (const Metric& metric : metrics())
        if (hasFrames(metric)) text.append(",").append(metric.column);
    text += "\n";
    for (const MomentMetrics& moment : runMetrics.frames) {
        text += std::to_string(moment.frame) + "," + files::csvNumber(moment.timeSeconds);
        for (const Metric& metric : metrics()) {
            if (!hasFrames(metric)) continue;
            const std::optional<double>& value = moment.values.of(metric.column);
            text += "," + (value ? files::csvNumber(*value) : "");
        }
        text += "\n";
    }
    return text;
}

std::vector<std::pair<std::string, double>> summaryOf(const RunMetrics& runMetrics) {
    std::vector<std::pair<std::string, double>> cells;
    for (const Metric& metric : metrics())
        if (const std::optional<double> value = valueOfRun(runMetrics, metric))
            cells.emplace_back(metric.column, *value);
    return cells;
}

std::string volumeWarning(const RunMetrics& runMetrics) {
    for (const auto& [column, value] : summaryOf(runMetrics))
        if (column == "volume_picture" && value > maximumVolumePicture)
            return fmt::format(
                "the method does not draw the volume that it reports: volume_picture is {:.2f}, allowed: up to {}; "
                "volume_error describes that volume, not the picture",
                value, maximumVolumePicture);
    return {};
}

}  // namespace dustbench::bench
