#include "bench/measure/image/masked_error.h"

#include <array>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/separable_filter.h"

namespace dustbench::measure {
namespace {

/// Sums over windows. Beyond the picture's edge there is no mask, so nothing is added.
PlaneOf<double> windowSums(const PlaneOf<double>& plane) {
    constexpr int reach = bandingWindow / 2;
    PlaneOf<double> bordered(plane.width + 2 * reach, plane.height + 2 * reach);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) bordered.at(x + reach, y + reach) = plane.at(x, y);
    std::array<double, bandingWindow> ones{};
    ones.fill(1);
    const PlaneOf<double> sums = blur<double>(bordered, ones);
    PlaneOf<double> inside(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) inside.at(x, y) = sums.at(x + reach, y + reach);
    return inside;
}

}  // namespace

std::optional<double> banding(const Picture& reference, const Picture& picture, const Mask& mask) {
    requireSameSize(reference, picture);
    requireSameSize(mask.width, mask.height, "the mask", picture.width, picture.height, picture.name);
    PlaneOf<double> within(mask.width, mask.height);
    for (std::size_t i = 0; i < mask.values.size(); ++i) within.values[i] = mask.values[i];
    const PlaneOf<double> pixels = windowSums(within);
    double squares = 0;
    std::int64_t count = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        PlaneOf<double> error(mask.width, mask.height);
        for (std::size_t i = 0; i < mask.values.size(); ++i)
            if (mask.values[i] != 0)
                error.values[i] = static_cast<double>(picture.linear[channel].values[i]) -
                                  static_cast<double>(reference.linear[channel].values[i]);
        const PlaneOf<double> sums = windowSums(error);
        for (std::size_t i = 0; i < mask.values.size(); ++i) {
            if (mask.values[i] == 0) continue;
            const double mean = sums.values[i] / pixels.values[i];
            squares += mean * mean;
            ++count;
        }
    }
    if (count == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(count));
}

namespace banding_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "banding",
                     .title = "error that neighbouring pixels with dust have in common, linear light; excludes noise",
                     .definition = "RMS over the mask of the linear error, averaged over the mask's pixels within "
                                   "5×5: this reduces noise to a fifth, and a wave of 20 pixels to 0.90",
                     .range = "0 …",
                     .unit = "linear light",
                     .emptyWhen = "no dust in view",
                     .perfect = "0",
                     .chartName = "banding",
                     .isFlaw = true,
                     .place = 9,
                     .round = 5}},
        .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
            return {banding(moment.reference, moment.picture, moment.mask)};
        }};
}

}  // namespace banding_metric

}  // namespace dustbench::measure
