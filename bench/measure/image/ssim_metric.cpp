#include "bench/measure/image/picture_error.h"

#include <numeric>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/separable_filter.h"

namespace dustbench::measure {
namespace {

constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
constexpr int radius = ssimWindow / 2;

/// Double precision: variances of nearly uniform windows are differences of nearly equal numbers.
using Values = PlaneOf<double>;

Values product(const Plane& a, const Plane& b) {
    Values result(a.width, a.height);
    for (std::size_t i = 0; i < a.values.size(); ++i)
        result.values[i] = static_cast<double>(a.values[i]) * static_cast<double>(b.values[i]);
    return result;
}

Values widened(const Plane& plane) {
    Values result(plane.width, plane.height);
    result.values.assign(plane.values.begin(), plane.values.end());
    return result;
}

}  // namespace

Measured ssim(const Picture& reference, const Picture& picture) {
    requireSameSize(reference, picture);
    if (reference.width < ssimWindow || reference.height < ssimWindow) return {};
    const std::vector<double> window = gaussianKernel<double>(1.5, radius);
    const auto mean = [&](const Values& values) { return blur<double>(values, window); };
    const Values meanR = mean(widened(reference.luma)), meanI = mean(widened(picture.luma));
    const Values meanRR = mean(product(reference.luma, reference.luma));
    const Values meanII = mean(product(picture.luma, picture.luma));
    const Values meanRI = mean(product(reference.luma, picture.luma));

    Measured result{{}, Plane(reference.width - 2 * radius, reference.height - 2 * radius)};
    double sum = 0;
    for (int y = 0; y < result.map.height; ++y)
        for (int x = 0; x < result.map.width; ++x) {
            const std::size_t i = meanR.index(x + radius, y + radius);
            const double mr = meanR.values[i], mi = meanI.values[i];
            const double varianceR = meanRR.values[i] - mr * mr, varianceI = meanII.values[i] - mi * mi;
            const double covariance = meanRI.values[i] - mr * mi;
            const double value = (2 * (mr * mi) + c1) * (2 * covariance + c2) /
                                 ((mr * mr + mi * mi + c1) * (varianceR + varianceI + c2));
            result.map.at(x, y) = static_cast<float>(value);
            sum += value;
        }
    result.value = sum / static_cast<double>(result.map.values.size());
    return result;
}

namespace ssim_metric {

MetricGroup describe() {
    const auto ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
        const Measured similarity = ssim(moment.reference, moment.picture);
        return {similarity.value, meanWithin(similarity.map, moment.mask)};
    };
    return {
        .metrics = {{.column = "ssim",
                     .title = "structural similarity to the reference image; 1: identical",
                     .definition = "structural similarity of Rec. 709 luma; Gaussian window 11×11, σ 1.5, K 0.01 and "
                                   "0.03, population covariance, windows wholly inside the picture",
                     .range = "−1 … 1",
                     .emptyWhen = "the picture is smaller than a window",
                     .source = "Wang2004",
                     .perfect = "1",
                     .higherIsBetter = true,
                     .chartName = "SSIM",
                     .place = 2,
                     .round = 1},
                    {.column = "ssim_mask",
                     .title = "ssim of the windows around dust in either picture",
                     .definition = "mean of the map of `ssim` over the windows whose centre is in the mask, windows "
                                   "wholly inside the picture",
                     .range = "−1 … 1",
                     .emptyWhen = "no dust in view, or only within 5 pixels of the picture's edge",
                     .source = "Wang2004",
                     .perfect = "1",
                     .higherIsBetter = true,
                     .chartName = "SSIM within the mask",
                     .ranks = true,
                     .place = 6,
                     .round = 4}},
        .ofMoment = ofMoment};
}

}  // namespace ssim_metric

}  // namespace dustbench::measure
