#include "bench/judge/judgement.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "methods/shared/files/csv.h"

namespace dustbench::bench {
namespace {

using Metric = std::optional<double> MomentMetrics::*;

constexpr std::array<std::pair<std::string_view, Metric>, 12> metrics{{
    {"psnr_db", &MomentMetrics::psnrDb},
    {"ssim", &MomentMetrics::ssim},
    {"flip", &MomentMetrics::flip},
    {"rmse_linear", &MomentMetrics::rmseLinear},
    {"psnr_continuum_db", &MomentMetrics::psnrContinuumDb},
    {"gaps", &MomentMetrics::gaps},
    {"components", &MomentMetrics::components},
    {"components_reference", &MomentMetrics::componentsReference},
    {"cutoff", &MomentMetrics::cutoff},
    {"self_similarity", &MomentMetrics::selfSimilarity},
    {"quads_per_pixel", &MomentMetrics::quadsPerPixel},
    {"volume_error", &MomentMetrics::volumeError},
}};

}  // namespace

std::string metricsCsv(const Judgement& judgement) {
    std::string text = "frame,time_s";
    for (const auto& [name, metric] : metrics) text.append(",").append(name);
    text += ",identical,popping\n";
    const auto cell = [](const std::optional<double>& value) { return value ? files::csvNumber(*value) : ""; };
    for (const MomentMetrics& moment : judgement.frames) {
        text += std::to_string(moment.frame) + "," + files::csvNumber(moment.timeSeconds);
        for (const auto& [name, metric] : metrics) text += "," + cell(moment.*metric);
        text += moment.identical ? (*moment.identical ? ",1" : ",0") : ",";
        text += "," + cell(moment.popping) + "\n";
    }
    return text;
}

std::vector<std::pair<std::string, double>> summaryOf(const Judgement& judgement) {
    std::vector<std::pair<std::string, double>> cells;
    for (const auto& [name, metric] : metrics) {
        double sum = 0;
        int count = 0;
        for (const MomentMetrics& moment : judgement.frames)
            if (const std::optional<double>& value = moment.*metric) {
                sum += *value;
                ++count;
            }
        if (count > 0) cells.emplace_back(name, sum / count);
    }
    int moments = 0, identical = 0;
    for (const MomentMetrics& moment : judgement.frames) {
        moments += moment.identical ? 1 : 0;
        identical += moment.identical.value_or(false) ? 1 : 0;
    }
    if (moments > 0) cells.emplace_back("identical", identical == moments ? 1 : 0);
    if (judgement.popping) cells.emplace_back("popping", *judgement.popping);
    if (judgement.poppingMax) cells.emplace_back("popping_max", *judgement.poppingMax);
    return cells;
}

std::span<const MetricInfo> metricInfos() {
    static constexpr std::array<MetricInfo, 15> infos{{
        {"psnr_db", "peak signal-to-noise ratio against the exact picture, dB"},
        {"ssim", "structural similarity to the exact picture, 1: the same"},
        {"flip", "difference from the exact picture that an eye sees when the two alternate, 0: none"},
        {"rmse_linear", "root of the mean squared difference of linear light"},
        {"psnr_continuum_db", "psnr_db against 64 times as many particles, dB"},
        {"gaps", "share of the trail that is not covered"},
        {"components", "parts into which the trail falls"},
        {"components_reference", "parts into which the exact trail falls"},
        {"cutoff", "edges where dust meets ground and solids that are not there in truth, alpha per pixel"},
        {"self_similarity", "how much all primitives look alike, 0: not at all"},
        {"quads_per_pixel", "primitives by pixels of dust"},
        {"volume_error", "distance of the volume from the particles' own, 0: none"},
        {"identical", "1: every judged picture is the exact one"},
        {"popping", "what jumps from frame to frame and should not: mean over the last frames"},
        {"popping_max", "the largest of these jumps"},
    }};
    return infos;
}

}  // namespace dustbench::bench
