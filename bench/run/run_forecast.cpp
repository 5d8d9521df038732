#include "bench/run/run_forecast.h"

#include <algorithm>
#include <map>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/measure/image/popping.h"
#include "bench/run/judged_run.h"
#include "bench/run/measured_run.h"
#include "methods/contract/registry.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::run {

namespace fs = std::filesystem;
namespace {

/// Frames run until both limits are reached, or until the run ends.
constexpr std::int64_t minimumFrames = 4;
constexpr double minimumSeconds = 0.3;

/// Thrown to stop a run early.
struct Enough {};

double seconds(std::int64_t nanoseconds) {
    return 1e-9 * static_cast<double>(nanoseconds);
}

FramesBegun beginFrames(results::RunSpec spec, const fs::path& folder) {
    spec.metricPlan.reset();
    FramesBegun begun;
    const double untilCall = measure::secondsSinceProcessStart();
    const std::int64_t called = measure::steadyNow();
    std::int64_t first = 0, last = 0, frames = -1;
    const auto onProgress = [&](std::string_view phase, std::int64_t, std::int64_t) {
        if (phase == "preroll") return;
        last = measure::steadyNow();
        if (++frames == 0) first = last;
        if (frames >= minimumFrames && seconds(last - first) >= minimumSeconds) throw Enough();
    };
    try {
        (void)measureRun(spec, folder, {}, onProgress);
    } catch (const Enough&) {
    }
    // A method that does not support the scene has no frames.
    begun.untilFrames = untilCall + seconds((frames < 0 ? measure::steadyNow() : first) - called);
    if (frames > 0) begun.perFrame = seconds(last - first) / static_cast<double>(frames);
    return begun;
}

/// The metrics of the shortest run that has every kind of frame: plain ones, a moment, the beginning of a stretch.
MetricsBegun beginMetrics(results::RunSpec spec, const fs::path& folder, gpu::Device& device) {
    // A second moment after the end, so that work that continues up to the last moment is included.
    constexpr std::int64_t moment = 1, stretch = 2, end = 4;
    spec.warmup = 1;
    spec.frames = stretch + measure::PoppingSummary::minimumPairs + 1;
    spec.metricPlan->moments = exports::FrameRange{moment, end + 1, end + 1 - moment};

    const std::int64_t called = measure::steadyNow();
    std::map<std::int64_t, double> begins;  // of each frame, since the call
    const auto onProgress = [&](std::string_view, std::int64_t step, std::int64_t steps) {
        const std::int64_t frame = step - (steps - spec.frames);
        begins[frame] = seconds(measure::steadyNow() - called);
        if (frame == end) throw Enough();
    };
    try {
        (void)evaluateRun(spec, folder, device, {}, onProgress);
    } catch (const Enough&) {
    }
    return {.untilFrames = begins.at(-1),
            .perPlainFrame = (begins.at(moment) - begins.at(-1)) / (moment + 1),
            .perMoment = begins.at(stretch) - begins.at(moment),
            .perStretchFrame = (begins.at(end) - begins.at(stretch)) / (end - stretch)};
}

}  // namespace

RunForecast extrapolate(const results::RunSpec& spec, const FramesBegun& frames, const MetricsBegun& metrics) {
    RunForecast forecast;
    forecast.measuring = frames.untilFrames + frames.perFrame * static_cast<double>(spec.warmup + spec.frames);
    if (!spec.metricPlan) return forecast;
    const std::vector<std::int64_t> moments = spec.metricPlan->momentsOf(spec.frames);
    std::int64_t stretch = 0;
    for (const std::int64_t frame : reference::MetricPlan::stretchOf(spec.frames))
        if (!std::ranges::binary_search(moments, frame)) ++stretch;
    const auto evaluated = static_cast<std::int64_t>(moments.size());
    const std::int64_t plain = spec.warmup + spec.frames - evaluated - stretch;
    forecast.metricPlan = metrics.untilFrames + metrics.perPlainFrame * static_cast<double>(plain) +
                          metrics.perMoment * static_cast<double>(evaluated) +
                          metrics.perStretchFrame * static_cast<double>(stretch);
    return forecast;
}

RunForecast forecastRun(const results::RunSpec& spec, const fs::path& folder) {
    const FramesBegun frames = beginFrames(spec, folder);
    if (!spec.metricPlan || frames.perFrame == 0) return extrapolate(spec, frames, {});
    MetricsBegun metrics;
    withThreads(spec.threads, [&] {
        gpu::Device device;
        const MethodInfo& info = findMethod(spec.method);
        const auto method = info.create(results::resolveParameters(info, spec.parameters).method);
        if (whyNotEvaluated(*spec.metricPlan, *method).empty()) metrics = beginMetrics(spec, folder, device);
    });
    return extrapolate(spec, frames, metrics);
}

std::string cellOf(results::RunSpec run) {
    run.repetition = 1;
    run.seed = 1;
    run.metricPlan.reset();
    return results::canonicalKey(run);
}

void ForecastByCell::set(const results::RunSpec& cell, const RunForecast& forecast) {
    byCell_[cellOf(cell)] = forecast;
}

double ForecastByCell::seconds(const results::RunSpec& run) const {
    const auto found = byCell_.find(cellOf(run));
    if (found == byCell_.end()) return -1;
    return run.metricPlan ? found->second.seconds() : found->second.measuring;
}

RemainingTime::RemainingTime(const std::vector<const suite::PlannedRun*>& toDo, const ForecastByCell& forecasts,
                             double cooldownSeconds) {
    for (const suite::PlannedRun* run : toDo) {
        results::RunSpec cell = run->spec;
        cell.repetition = 1;
        const double forecast = forecasts.seconds(run->spec);
        const double rest = runs_.empty() ? 0 : cooldownSeconds;
        runs_.push_back({results::canonicalKey(cell), forecast < 0 ? forecast : forecast + rest});
    }
}

void RemainingTime::ended(std::size_t position, double seconds) {
    Run& run = runs_.at(position);
    for (Ended* each : {&byCell_[run.cell], &all_}) {
        each->sum += seconds;
        ++each->count;
    }
    run.ended = true;
}

double RemainingTime::seconds() const {
    double sum = 0;
    for (const auto& [cell, forecast, isOver] : runs_) {
        if (isOver) continue;
        if (const auto ended = byCell_.find(cell); ended != byCell_.end())
            sum += ended->second.mean();
        else if (forecast >= 0)
            sum += forecast;
        else if (all_.count > 0)
            sum += all_.mean();
        else
            return -1;
    }
    return sum;
}

}  // namespace dustbench::run
