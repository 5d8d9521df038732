#include "bench/measure/image/masked_error.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {
namespace {

/// Sums over the differences between two pictures within a mask.
struct Differences {
    double squares = 0, maximum = 0;
    std::int64_t count = 0;
};

Differences differencesWithin(const std::array<Plane, 3>& reference, const std::array<Plane, 3>& picture,
                              const Mask& mask) {
    Differences differences;
    for (std::size_t i = 0; i < mask.values.size(); ++i) {
        if (mask.values[i] == 0) continue;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double difference =
                static_cast<double>(picture[channel].values[i]) - static_cast<double>(reference[channel].values[i]);
            differences.squares += difference * difference;
            differences.maximum = std::max(differences.maximum, std::abs(difference));
            ++differences.count;
        }
    }
    return differences;
}

}  // namespace

Mask dustMask(const Plane& alpha, const Plane& referenceAlpha) {
    requireSameSize(alpha, "the method's layer", referenceAlpha, "the reference's layer");
    Mask mask(alpha.width, alpha.height);
    for (std::size_t i = 0; i < mask.values.size(); ++i)
        mask.values[i] = alpha.values[i] > maskAlpha || referenceAlpha.values[i] > maskAlpha;
    return mask;
}

MaskedError maskedError(const Picture& reference, const Picture& picture, const Mask& mask) {
    requireSameSize(reference, picture);
    requireSameSize(mask.width, mask.height, "the mask", picture.width, picture.height, picture.name);
    const Differences encoded = differencesWithin(reference.encoded, picture.encoded, mask);
    const Differences linear = differencesWithin(reference.linear, picture.linear, mask);
    MaskedError error;
    if (encoded.count == 0) return error;
    const auto count = static_cast<double>(encoded.count);
    if (encoded.squares > 0) error.psnrDb = -10 * std::log10(encoded.squares / count);
    error.rmseLinear = std::sqrt(linear.squares / count);
    error.maximum = linear.maximum;
    return error;
}

std::optional<double> meanWithin(const Plane& map, const Mask& mask) {
    const int left = (mask.width - map.width) / 2, top = (mask.height - map.height) / 2;
    double sum = 0;
    std::int64_t pixels = 0;
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            if (mask.at(x + left, y + top) == 0) continue;
            sum += static_cast<double>(map.at(x, y));
            ++pixels;
        }
    return pixels > 0 ? std::optional(sum / static_cast<double>(pixels)) : std::nullopt;
}

namespace masked_error_metric {

MetricGroup describe() {
    const auto ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
        const MaskedError error = maskedError(moment.reference, moment.picture, moment.mask);
        return {error.psnrDb, error.rmseLinear, error.maximum};
    };
    return {
        .metrics = {{.column = "psnr_mask_db",
                     .title = "psnr_db within the pixels that contain dust in either picture, dB",
                     .definition = "`psnr_db` within the mask",
                     .range = "0 …",
                     .unit = "dB",
                     .emptyWhen = "no dust in view, or identical within the mask",
                     .perfect = "identical",
                     .higherIsBetter = true,
                     .chartName = "PSNR within the mask",
                     .ranks = true,
                     .place = 5,
                     .round = 4},
                    {.column = "rmse_linear_mask",
                     .title = "rmse_linear within the pixels that contain dust in either picture",
                     .definition = "`rmse_linear` within the mask",
                     .range = "0 …",
                     .unit = "linear light",
                     .emptyWhen = "no dust in view",
                     .perfect = "0",
                     .chartName = "RMSE within the mask",
                     .place = 7,
                     .round = 4},
                    {.column = "error_max",
                     .title = "maximum error of a pixel with dust, linear light",
                     .definition = "maximum of \\|I − R\\| over the pixels of the mask and the three linear channels",
                     .range = "0 …",
                     .unit = "linear light",
                     .emptyWhen = "no dust in view",
                     .perfect = "0",
                     .chartName = "maximum pixel error",
                     .isFlaw = true,
                     .place = 8,
                     .round = 4}},
        .ofMoment = ofMoment};
}

}  // namespace masked_error_metric

}  // namespace dustbench::measure
