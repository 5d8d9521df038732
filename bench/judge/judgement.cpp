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

const std::vector<std::string>& metricColumns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const auto& [name, metric] : metrics) list.emplace_back(name);
        for (const char* name : {"identical", "popping", "popping_max"}) list.emplace_back(name);
        return list;
    }();
    return names;
}

}  // namespace dustbench::bench
