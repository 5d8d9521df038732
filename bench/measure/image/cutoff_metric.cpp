#include "bench/measure/image/flaw_metrics.h"

#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {

Measured cutoff(const Plane& alpha, const Plane& alphaFree, const Plane& referenceAlpha,
                const Plane& referenceAlphaFree) {
    for (const Plane* plane : {&alphaFree, &referenceAlpha, &referenceAlphaFree})
        requireSameSize(*plane, "an alpha without the scene's depth, or the reference's", alpha, "the alpha");
    Plane cut(alpha.width, alpha.height);
    for (std::size_t i = 0; i < cut.values.size(); ++i)
        cut.values[i] =
            (alpha.values[i] - alphaFree.values[i]) - (referenceAlpha.values[i] - referenceAlphaFree.values[i]);

    Measured result{{}, Plane(alpha.width, alpha.height)};
    double sum = 0;
    std::size_t pixels = 0;
    for (int y = 0; y + 1 < cut.height; ++y)
        for (int x = 0; x + 1 < cut.width; ++x) {
            if (!(alphaFree.at(x, y) > dustAlpha || referenceAlphaFree.at(x, y) > dustAlpha)) continue;
            const double right = static_cast<double>(cut.at(x + 1, y)) - static_cast<double>(cut.at(x, y));
            const double down = static_cast<double>(cut.at(x, y + 1)) - static_cast<double>(cut.at(x, y));
            result.map.at(x, y) = static_cast<float>(std::sqrt(right * right + down * down));
            sum += right * right + down * down;
            ++pixels;
        }
    if (pixels > 0) result.value = std::sqrt(sum / static_cast<double>(pixels));
    return result;
}

namespace cutoff_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "cutoff",
                     .title = "hard edges where dust meets ground or solids that the reference lacks, alpha per pixel",
                     .definition = "RMS of ∇[(α − α_free) − (R − R_free)] where α_free or R_free > 0.01; `_free`: "
                                   "drawn without the scene's depth; ∇: differences to the right and down",
                     .range = "0 … 2.83",
                     .unit = "alpha/pixel",
                     .emptyWhen = "no dust in view",
                     .perfect = "0",
                     .chartName = "cut-off at surfaces",
                     .isFlaw = true,
                     .needs = Needs::layersWithoutScene,
                     .place = 19,
                     .round = 1}},
        .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
            return {cutoff(moment.alpha, moment.alphaFree, moment.referenceAlpha, moment.referenceAlphaFree).value};
        }};
}

}  // namespace cutoff_metric

}  // namespace dustbench::measure
