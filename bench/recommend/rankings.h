// Settings of methods that were measured in one world, with their times and the quality of their pictures.
//
// Times and pictures may come from different runs, which are joined by method, parameters, world and machine. Worlds,
// ways of timing (sync, threads, frames), references and lengths of the runs with metrics are never mixed: each
// combination is a separate ranking. A value is the median over the seeds, or over the repetitions of a single seed,
// with the interval of median_interval.h. Units: as the columns of summary.csv. Threads: pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/measure/image/metric.h"
#include "bench/recommend/measured_runs.h"
#include "bench/report/median_interval.h"

namespace dustbench::recommend {

/// The column of a method's own time.
inline constexpr std::string_view timeColumn = "method_ms_median";

/// The metrics that can rank pictures, and those that measure flaws.
[[nodiscard]] std::vector<measure::Metric> qualityMetrics();
[[nodiscard]] std::vector<measure::Metric> flawMetrics();
/// Throws InputError that begins with `what`.
[[nodiscard]] measure::Metric qualityMetric(const std::string& what, const std::string& column);

/// One method with one set of parameters.
struct MeasuredSetting {
    std::string method;
    SettingTexts own;
    std::string label{};          ///< `billboard soft=on`: parameters other than the defaults, and those that vary
    report::MedianInterval ms{};  ///< the method's own time
    std::size_t timedSeeds = 1;
    report::MedianInterval quality{};                                      ///< `values`: the number of seeds
    std::map<std::string, report::MedianInterval, std::less<>> metrics{};  ///< by column, if measured
    bool otherRuns = false;  ///< some of its metrics are from runs without a time
    bool onFront = false;    ///< every other setting costs more or has worse quality, by intervals without overlap
};

struct Ranking {
    SettingTexts world, conduct;
    std::string label{};          ///< `scene=plain drive=straight size=320x240 particles=500`
    std::string evaluatedFrames;  ///< length of the runs with metrics
    std::string reference;        ///< `exact`, or a finer setting
    std::size_t machine = 0;
    std::vector<MeasuredSetting> settings{};  ///< best picture first
};

/// A setting that cannot be ranked.
struct Incomplete {
    std::string label, world;
    bool hasTime = false, hasQuality = false;
};

struct Rankings {
    measure::Metric quality;
    std::vector<Ranking> rankings;  ///< each with one setting or more
    std::vector<Incomplete> incomplete;
};

[[nodiscard]] Rankings rankSettings(const MeasuredRuns& runs, const measure::Metric& quality);

/// True if every value in the interval of `a` is better than every value in that of `b`.
[[nodiscard]] bool isClearlyBetter(const report::MedianInterval& a, const report::MedianInterval& b,
                                   const measure::Metric& metric);
[[nodiscard]] bool isBetter(double a, double b, const measure::Metric& metric);

}  // namespace dustbench::recommend
