#include "bench/measure/image/volume_error.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {

std::optional<double> volumePicture(const Plane& alpha, const Plane& volumeAlpha) {
    requireSameSize(alpha, "the method's layer", volumeAlpha, "its volume's layer");
    double differences = 0, squares = 0, volumeSquares = 0;
    for (std::size_t i = 0; i < alpha.values.size(); ++i) {
        const auto a = static_cast<double>(alpha.values[i]), b = static_cast<double>(volumeAlpha.values[i]);
        differences += (a - b) * (a - b);
        squares += a * a;
        volumeSquares += b * b;
    }
    const double larger = std::max(squares, volumeSquares);
    return larger > 0 ? std::optional(std::sqrt(differences / larger)) : std::nullopt;
}

namespace volume_picture_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "volume_picture",
                     .title = "distance of the picture from that of the method's reported volume; 0: none",
                     .definition = "‖α − α_V‖ / max(‖α‖, ‖α_V‖) over all pixels; α_V: exact alpha of the volume that "
                                   "the method reports",
                     .range = "0 … √2",
                     .emptyWhen = "neither shows any dust, or the method reports no volume",
                     .perfect = "0",
                     .chartName = "difference of reported volume and picture",
                     .needs = Needs::ownVolume,
                     .place = 23,
                     .round = 4}},
        .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
            return {volumePicture(moment.alpha, moment.volumeAlpha)};
        }};
}

}  // namespace volume_picture_metric

}  // namespace dustbench::measure
