// Settings of methods that were measured in one world, with their times and the quality of their pictures.
//
// Times and pictures may come from different runs, which are joined by method, parameters, world and machine. Worlds,
// ways of timing (sync, threads, frames), references and lengths of the runs with metrics are never mixed: each
// combination is a separate ranking. A value is the median over the seeds, or over the repetitions of a single seed,
// with the interval of median_interval.h. Units: as the columns of summary.csv. Threads: pure.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bench/recommend/measured_runs.h"
#include "bench/report/median_interval.h"

namespace dustbench::bench {

/// The column of a method's own time.
inline constexpr std::string_view timeColumn = "method_ms_median";

/// A metric that ranks pictures, or one that measures a flaw. reports/METRICS.md defines them.
struct PictureMetric {
    std::string_view column, unit;
    std::string_view perfect;  ///< value of a picture that equals the reference
    bool higherIsBetter = false;
};
inline constexpr std::array<PictureMetric, 3> qualityMetrics{
    {{"psnr_mask_db", "dB", "identical", true}, {"ssim_mask", "", "1", true}, {"flip_mask", "", "0", false}}};
inline constexpr std::array<PictureMetric, 10> flawMetrics{{{"popping", "encoded value", "0"},
                                                            {"gaps", "share of the trail", "0"},
                                                            {"spill", "share of the shown trail", "0"},
                                                            {"components", "parts", "as the reference"},
                                                            {"cutoff", "alpha/pixel", "0"},
                                                            {"self_similarity", "", "0"},
                                                            {"banding", "linear light", "0"},
                                                            {"error_max", "linear light", "0"},
                                                            {"quads_per_pixel", "1/pixel", "any"},
                                                            {"volume_error", "", "0"}}};
/// Throws InputError that begins with `what`.
[[nodiscard]] const PictureMetric& qualityMetric(const std::string& what, const std::string& column);

/// One method with one set of parameters.
struct MeasuredSetting {
    std::string method;
    SettingTexts own;
    std::string label{};  ///< `billboard soft=on`: parameters other than the defaults, and those that vary
    MedianInterval ms{};  ///< the method's own time
    std::size_t timedSeeds = 1;
    MedianInterval quality{};                                      ///< `values`: the number of seeds
    std::map<std::string, MedianInterval, std::less<>> metrics{};  ///< by column, if measured
    bool otherRuns = false;                                        ///< some of its metrics are from runs without a time
    bool onFront = false;  ///< every other setting costs more or has worse quality, by intervals without overlap
};

struct Ranking {
    SettingTexts world, conduct;
    std::string label{};       ///< `scene=plain drive=straight size=320x240 particles=500`
    std::string judgedFrames;  ///< length of the runs with metrics
    std::string reference;     ///< `exact`, or a finer setting
    std::size_t machine = 0;
    std::vector<MeasuredSetting> settings{};  ///< best picture first
};

/// A setting that cannot be ranked.
struct Incomplete {
    std::string label, world;
    bool hasTime = false, hasQuality = false;
};

struct Rankings {
    PictureMetric quality;
    std::vector<Ranking> rankings;  ///< each with one setting or more
    std::vector<Incomplete> incomplete;
};

[[nodiscard]] Rankings rankSettings(const MeasuredRuns& runs, const PictureMetric& quality);

/// True if every value in the interval of `a` is better than every value in that of `b`.
[[nodiscard]] bool isClearlyBetter(const MedianInterval& a, const MedianInterval& b, const PictureMetric& metric);
[[nodiscard]] bool isBetter(double a, double b, const PictureMetric& metric);

}  // namespace dustbench::bench
