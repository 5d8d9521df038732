#include "bench/reference/judge/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "bench/measure/image/volume_picture.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

using Metric = std::optional<double> MomentMetrics::*;

struct MeanMetric {
    MetricInfo info;
    Metric of;
};

/// The metrics that a run reports as a mean over its moments.
constexpr std::array<MeanMetric, 20> means{{
    {{"psnr_db", "peak signal-to-noise ratio against the reference image, dB"}, &MomentMetrics::psnrDb},
    {{"ssim", "structural similarity to the reference image; 1: identical"}, &MomentMetrics::ssim},
    {{"flip", "difference that a viewer sees when flipping to the reference image; 0: none"}, &MomentMetrics::flip},
    {{"flip_mask", "flip within the pixels that contain dust in either picture"}, &MomentMetrics::flipMask},
    {{"psnr_mask_db", "psnr_db within the pixels that contain dust in either picture, dB"}, &MomentMetrics::psnrMaskDb},
    {{"ssim_mask", "ssim of the windows around dust in either picture"}, &MomentMetrics::ssimMask},
    {{"rmse_linear_mask", "rmse_linear within the pixels that contain dust in either picture"},
     &MomentMetrics::rmseLinearMask},
    {{"error_max", "maximum error of a pixel with dust, linear light"}, &MomentMetrics::errorMax},
    {{"banding", "error that neighbouring pixels with dust have in common, linear light; excludes noise"},
     &MomentMetrics::banding},
    {{"rmse_linear", "root of the mean squared difference of linear light"}, &MomentMetrics::rmseLinear},
    {{"psnr_continuum_db", "psnr_db against a reference with 64 times as many particles, dB"},
     &MomentMetrics::psnrContinuumDb},
    {{"gaps", "share of the trail that is not covered"}, &MomentMetrics::gaps},
    {{"spill", "share of the method's trail with more than twice the reference's alpha"}, &MomentMetrics::spill},
    {{"components", "number of separate parts of the trail"}, &MomentMetrics::components},
    {{"components_reference", "number of separate parts of the reference's trail"},
     &MomentMetrics::componentsReference},
    {{"cutoff", "hard edges where dust meets ground or solids that the reference lacks, alpha per pixel"},
     &MomentMetrics::cutoff},
    {{"self_similarity", "similarity of the primitives to each other; 0: none"}, &MomentMetrics::selfSimilarity},
    {{"quads_per_pixel", "primitives per pixel of dust"}, &MomentMetrics::quadsPerPixel},
    {{"volume_error", "distance of the method's volume from that of the particles; 0: none"},
     &MomentMetrics::volumeError},
    {{"volume_picture", "distance of the picture from that of the method's reported volume; 0: none"},
     &MomentMetrics::volumePicture},
}};
constexpr std::array<MetricInfo, 7> others{{
    {"identical", "1: every compared picture equals its reference image"},
    {"popping", "jumps from frame to frame that the reference lacks: mean over the last frames"},
    {"popping_max", "maximum of these jumps"},
    {"popping_small", "popping where the smaller primitives show"},
    {"popping_large", "popping where the larger primitives show"},
    {"popping_small_part", "contribution of the smaller primitives' pixels to popping; the squares of both add up"},
    {"popping_large_part", "contribution of the larger primitives' pixels to popping"},
}};

}  // namespace

std::string metricsCsv(const Judgement& judgement) {
    std::string text = "frame,time_s";
    for (const MeanMetric& metric : means) text.append(",").append(metric.info.column);
    text += ",identical,popping\n";
    const auto cell = [](const std::optional<double>& value) { return value ? files::csvNumber(*value) : ""; };
    for (const MomentMetrics& moment : judgement.frames) {
        text += std::to_string(moment.frame) + "," + files::csvNumber(moment.timeSeconds);
        for (const MeanMetric& metric : means) text += "," + cell(moment.*metric.of);
        text += moment.identical ? (*moment.identical ? ",1" : ",0") : ",";
        text += "," + cell(moment.popping) + "\n";
    }
    return text;
}

std::vector<std::pair<std::string, double>> summaryOf(const Judgement& judgement) {
    std::vector<std::pair<std::string, double>> cells;
    for (const MeanMetric& metric : means) {
        double sum = 0;
        int count = 0;
        for (const MomentMetrics& moment : judgement.frames)
            if (const std::optional<double>& value = moment.*metric.of) {
                sum += *value;
                ++count;
            }
        if (count > 0) cells.emplace_back(metric.info.column, sum / count);
    }
    int moments = 0, identical = 0;
    for (const MomentMetrics& moment : judgement.frames) {
        moments += moment.identical ? 1 : 0;
        identical += moment.identical.value_or(false) ? 1 : 0;
    }
    if (moments > 0) cells.emplace_back("identical", identical == moments ? 1 : 0);
    const auto add = [&](std::string_view column, const std::optional<double>& value) {
        if (value) cells.emplace_back(column, *value);
    };
    add("popping", judgement.popping);
    add("popping_max", judgement.poppingMax);
    add("popping_small", judgement.poppingBySize.small);
    add("popping_large", judgement.poppingBySize.large);
    add("popping_small_part", judgement.poppingBySize.smallPart);
    add("popping_large_part", judgement.poppingBySize.largePart);
    return cells;
}

std::string volumeWarning(const Judgement& judgement) {
    for (const auto& [column, value] : summaryOf(judgement))
        if (column == "volume_picture" && value > maximumVolumePicture)
            return fmt::format(
                "the method does not draw the volume that it reports: volume_picture is {:.2f}, allowed: up to {}; "
                "volume_error describes that volume, not the picture",
                value, maximumVolumePicture);
    return {};
}

std::span<const MetricInfo> metricInfos() {
    static const std::vector<MetricInfo> infos = [] {
        std::vector<MetricInfo> list;
        list.reserve(means.size() + others.size());
        for (const MeanMetric& metric : means) list.push_back(metric.info);
        list.insert(list.end(), others.begin(), others.end());
        return list;
    }();
    return infos;
}

}  // namespace dustbench::bench
