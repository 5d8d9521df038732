#include "bench/measure/image/popping.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {
namespace {

void requireOneSize(const DustFrame& frame, const DustFrame& first) {
    requireSameSize(frame.image, first.image);
    requireSameSize(frame.reference, first.image);
    for (const Plane* alpha : {&frame.alpha, &frame.referenceAlpha})
        requireSameSize(alpha->width, alpha->height, "the alpha of " + frame.image.name, first.image.width,
                        first.image.height, first.image.name);
}

}  // namespace

bool hasDust(const DustFrame& before, const DustFrame& now, std::size_t pixel) {
    return before.alpha.values[pixel] > dustAlpha || before.referenceAlpha.values[pixel] > dustAlpha ||
           now.alpha.values[pixel] > dustAlpha || now.referenceAlpha.values[pixel] > dustAlpha;
}

Measured popping(const DustFrame& before, const DustFrame& now) {
    requireOneSize(before, before);
    requireOneSize(now, before);
    Measured result{{}, Plane(now.image.width, now.image.height)};
    double sum = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < result.map.values.size(); ++i) {
        if (!hasDust(before, now, i)) continue;
        double squares = 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const auto step = [&](const Picture& from, const Picture& to) {
                return static_cast<double>(to.encoded[channel].values[i]) -
                       static_cast<double>(from.encoded[channel].values[i]);
            };
            const double excess = step(before.image, now.image) - step(before.reference, now.reference);
            squares += excess * excess;
        }
        result.map.values[i] = static_cast<float>(std::sqrt(squares / 3));
        sum += squares / 3;
        ++pixels;
    }
    if (pixels > 0) result.value = std::sqrt(sum / static_cast<double>(pixels));
    return result;
}

void PoppingSummary::add(const std::optional<double>& pair) {
    if (!pair) return endStretch();
    current_ = {current_.pairs + 1, current_.sum + *pair, std::max(current_.maximum, *pair)};
}

void PoppingSummary::endStretch() {
    ended_ = counted();
    current_ = {};
}

PoppingSummary::Stretch PoppingSummary::counted() const {
    if (current_.pairs < minimumPairs) return ended_;
    return {ended_.pairs + current_.pairs, ended_.sum + current_.sum, std::max(ended_.maximum, current_.maximum)};
}

std::optional<double> PoppingSummary::mean() const {
    const Stretch stretch = counted();
    if (stretch.pairs == 0) return {};
    return stretch.sum / static_cast<double>(stretch.pairs);
}

std::optional<double> PoppingSummary::maximum() const {
    const Stretch stretch = counted();
    if (stretch.pairs == 0) return {};
    return stretch.maximum;
}

namespace popping_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "popping",
                     .title = "jumps from frame to frame that the reference lacks: mean over the last frames",
                     .definition =
                         "RMS of (Iₜ − Iₜ₋₁) − (Rₜ − Rₜ₋₁) where α or R > 0.01 in either frame; mean over the pairs",
                     .range = "0 … 2",
                     .unit = "encoded value",
                     .emptyWhen = "no unbroken stretch of 30 pairs with dust in view",
                     .perfect = "0",
                     .chartName = "popping",
                     .isFlaw = true,
                     .overRun = OverRun::pairs,
                     .needs = Needs::pairs,
                     .place = 12,
                     .round = 1},
                    {.column = "popping_max",
                     .title = "maximum of these jumps",
                     .definition = "maximum over the pairs",
                     .range = "0 … 2",
                     .unit = "encoded value",
                     .emptyWhen = "as `popping`",
                     .perfect = "0",
                     .chartName = "popping of the worst pair of frames",
                     .overRun = OverRun::whole,
                     .needs = Needs::pairs,
                     .place = 13,
                     .round = 1}},
        .ofRun = [](const PoppingOfRun& run) -> MetricGroup::Values {
            return {run.summary.mean(), run.summary.maximum()};
        }};
}

}  // namespace popping_metric

}  // namespace dustbench::measure
