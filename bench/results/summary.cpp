#include "bench/results/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <tuple>

#include "bench/measure/image/metric.h"
#include "bench/measure/statistics.h"
#include "bench/results/method_facts.h"
#include "methods/kit/files/csv.h"

namespace dustbench::results {

using files::csvCell;
using files::csvNumber;

namespace {

std::vector<double> columnOf(std::span<const measure::FrameRecord> frames,
                             const std::function<double(const measure::FrameRecord&)>& of) {
    std::vector<double> values;
    values.reserve(frames.size());
    for (const measure::FrameRecord& frame : frames) values.push_back(of(frame));
    return values;
}

std::int64_t largest(std::span<const measure::FrameRecord> frames, std::int64_t measure::FrameRecord::*member) {
    std::int64_t value = 0;
    for (const measure::FrameRecord& frame : frames) value = std::max(value, frame.*member);
    return value;
}

/// A share of less than one frame gives no value.
bool hasShare(std::span<const double> frames, double share) {
    return static_cast<double>(frames.size()) * share >= 1 - 1e-9;
}

/// The time that `share` of the frames exceed; NaN for too few frames.
double upperPercentile(std::span<const double> frameMs, double share) {
    return hasShare(frameMs, share) ? measure::quantile(frameMs, 1 - share) : std::numeric_limits<double>::quiet_NaN();
}

double slowestFps(std::span<const double> frameMs, double share) {
    return hasShare(frameMs, share) ? measure::lowFps(frameMs, share) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<std::string>& columnsBeforeParameters() {
    static const std::vector<std::string> names{"run_id", "status",     "reason", "method", "scene", "drive",
                                                "seed",   "repetition", "width",  "height", "sync",  "threads"};
    return names;
}

/// Columns are only ever added: each extension of the table added metrics (Metric::round) and other columns.
const std::vector<std::string>& columnsAfterParameters() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        const auto add = [&](std::initializer_list<const char*> columns) {
            list.insert(list.end(), columns.begin(), columns.end());
        };
        int round = 1;
        const auto addMetrics = [&] {
            std::vector<measure::Metric> ofRound = measure::metrics();
            std::erase_if(ofRound, [&](const measure::Metric& metric) { return metric.round != round; });
            std::ranges::sort(ofRound, {},
                              [](const measure::Metric& metric) { return std::tuple(metric.place, metric.column); });
            for (const measure::Metric& metric : ofRound) list.emplace_back(metric.column);
            ++round;
        };
        add({"frames", "fps_avg", "frame_ms_median", "frame_ms_p95", "frame_ms_p99", "frame_ms_max", "fps_1pct_low"});
        for (const std::string_view stage : stageNames) list.push_back(std::string(stage) + "_ms_median");
        add({"cpu_bytes", "gpu_bytes", "rss_peak_bytes", "energy_j", "particles_median", "primitives_median"});
        addMetrics();
        add({"FILE_image", "FILE_volume", "gpu_ms_median", "harness_us_median"});
        addMetrics();
        add({"metric_reference", "frame_ms_p999", "fps_01pct_low", "start_s", "gpu_driver_bytes", "energy_cpu_j",
             "energy_gpu_j", "frame_ms_min"});
        addMetrics();
        add({"method_ms_median"});
        addMetrics();
        add({"invalid"});
        addMetrics();
        add({"run_s", "gpu_mhz_min", "gpu_mhz_max", "dust_on"});
        addMetrics();
        for (const MethodFact& fact : methodFacts()) list.push_back(fact.info.name);
        return list;
    }();
    return names;
}

const std::vector<std::string>& numericColumns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list = columnsAfterParameters();
        std::erase_if(list, [](const std::string& name) {
            return name.starts_with("FILE_") || name == "metric_reference" || name == "invalid" || name == "dust_on";
        });
        return list;
    }();
    return names;
}

bool dependsOnSpeed(std::string_view column) {
    return column.starts_with("fps_") || column.starts_with("frame_ms_") || column.ends_with("_ms_median") ||
           column.starts_with("energy_") || column.starts_with("gpu_mhz_") || column == "harness_us_median" ||
           column == "start_s" || column == "run_s";
}

Columns identityColumns(const RunRecord& record, int threads) {
    const RunSpec& spec = record.spec;
    return {{"run_id", runId(spec)},
            {"status", std::string(runStatuses.wordOf(record.status))},
            {"reason", record.reason},
            {"method", spec.method},
            {"scene", spec.scene},
            {"drive", record.drive},
            {"seed", static_cast<std::int64_t>(spec.seed)},
            {"repetition", std::int64_t{spec.repetition}},
            {"width", std::int64_t{spec.size.width}},
            {"height", std::int64_t{spec.size.height}},
            {"sync", std::string(syncs.wordOf(spec.sync))},
            {"threads", std::int64_t{threads}},
            {"dust_on", record.provenance.dustOn.place}};
}

Columns measuredColumns(std::span<const measure::FrameRecord> frames, const WholeRun& run) {
    const auto frameMs = columnOf(frames, [](const measure::FrameRecord& frame) { return frame.frameMs; });
    Columns columns{
        {"frames", static_cast<std::int64_t>(frames.size())}, {"fps_avg", measure::averageFps(frameMs)},
        {"frame_ms_median", measure::median(frameMs)},        {"frame_ms_p95", upperPercentile(frameMs, 0.05)},
        {"frame_ms_p99", upperPercentile(frameMs, 0.01)},     {"frame_ms_max", measure::maximum(frameMs)},
        {"fps_1pct_low", slowestFps(frameMs, 0.01)},          {"frame_ms_p999", upperPercentile(frameMs, 0.001)},
        {"fps_01pct_low", slowestFps(frameMs, 0.001)},        {"frame_ms_min", measure::minimum(frameMs)}};
    for (std::size_t stage = 0; stage < stageNames.size(); ++stage)
        columns.emplace_back(std::string(stageNames[stage]) + "_ms_median",
                             measure::median(columnOf(
                                 frames, [stage](const measure::FrameRecord& frame) { return frame.stageMs[stage]; })));
    columns.emplace_back("cpu_bytes", largest(frames, &measure::FrameRecord::cpuBytes));
    columns.emplace_back("gpu_bytes", largest(frames, &measure::FrameRecord::gpuBytes));
    columns.emplace_back("rss_peak_bytes", run.peakResidentBytes);
    columns.emplace_back("particles_median", measure::median(columnOf(frames, [](const measure::FrameRecord& frame) {
                             return static_cast<double>(frame.particles);
                         })));
    columns.emplace_back("primitives_median", measure::median(columnOf(frames, [](const measure::FrameRecord& frame) {
                             return static_cast<double>(frame.primitives);
                         })));
    std::vector<double> gpuMs;
    for (const measure::FrameRecord& frame : frames)
        if (frame.gpuMs) gpuMs.push_back(*frame.gpuMs);
    columns.emplace_back("gpu_ms_median", measure::median(gpuMs));
    columns.emplace_back(
        "harness_us_median",
        measure::median(columnOf(frames, [](const measure::FrameRecord& frame) { return frame.harnessMs() * 1000; })));
    const auto add = [&columns](const char* name, const auto& value) {
        if (value) columns.emplace_back(name, *value);
    };
    add("start_s", run.startSeconds);
    add("gpu_driver_bytes", run.driverBytes);
    if (run.gpuMegahertz) {
        columns.emplace_back("gpu_mhz_min", run.gpuMegahertz->first);
        columns.emplace_back("gpu_mhz_max", run.gpuMegahertz->second);
    }
    const auto perFrame = [&](std::optional<double> joules) {
        if (joules) *joules /= static_cast<double>(std::max<std::size_t>(frames.size(), 1));
        return joules;
    };
    const std::optional<double> cpu = perFrame(run.cpuJoules), gpu = perFrame(run.gpuJoules);
    add("energy_cpu_j", cpu);
    add("energy_gpu_j", gpu);
    // A sum that lacks a part would look like a saving.
    if (cpu && (gpu || run.softwareRenderer)) columns.emplace_back("energy_j", *cpu + gpu.value_or(0));
    return columns;
}

std::string framesCsv(std::span<const measure::FrameRecord> frames) {
    std::string text = "frame,time_s,frame_ms";
    const auto out = std::back_inserter(text);
    for (const std::string_view stage : stageNames) fmt::format_to(out, ",{}_ms", stage);
    text += ",gpu_ms,particles,primitives,cpu_bytes,gpu_bytes,rss_bytes\n";
    for (const measure::FrameRecord& frame : frames) {
        fmt::format_to(out, "{},{},{}", frame.frame, csvNumber(frame.timeSeconds), csvNumber(frame.frameMs));
        for (const double ms : frame.stageMs) fmt::format_to(out, ",{}", csvNumber(ms));
        fmt::format_to(out, ",{}", frame.gpuMs ? csvNumber(*frame.gpuMs) : "");
        fmt::format_to(out, ",{},{},{},{},{}\n", frame.particles, frame.primitives, frame.cpuBytes, frame.gpuBytes,
                       frame.rssBytes);
    }
    return text;
}

std::string stagesCsv(std::span<const measure::FrameRecord> frames) {
    std::string text = "frame,stage,detail,ms\n";
    for (const measure::FrameRecord& frame : frames)
        for (const measure::FrameRecord::Detail& detail : frame.details)
            fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", frame.frame,
                           stageNames[static_cast<std::size_t>(detail.stage)], csvCell(detail.name),
                           csvNumber(detail.ms));
    return text;
}

}  // namespace dustbench::results
