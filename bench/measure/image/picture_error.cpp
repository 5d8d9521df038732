#include "bench/measure/image/picture_error.h"

#include <algorithm>
#include <cmath>

namespace dustbench::bench {
namespace {

/// Squared difference averaged over the channels: per pixel and over the picture.
struct SquaredError {
    Plane rootPerPixel;
    double mean = 0;
};

SquaredError squaredError(const std::array<Plane, 3>& reference, const std::array<Plane, 3>& picture) {
    SquaredError error{Plane(reference[0].width, reference[0].height)};
    double sum = 0;
    for (std::size_t i = 0; i < error.rootPerPixel.values.size(); ++i) {
        double squares = 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double difference =
                static_cast<double>(picture[channel].values[i]) - static_cast<double>(reference[channel].values[i]);
            squares += difference * difference;
        }
        error.rootPerPixel.values[i] = static_cast<float>(std::sqrt(squares / 3));
        sum += squares / 3;
    }
    error.mean = sum / static_cast<double>(error.rootPerPixel.values.size());
    return error;
}

}  // namespace

PictureError pictureError(const Picture& reference, const Picture& picture) {
    requireSameSize(reference, picture);
    SquaredError encoded = squaredError(reference.encoded, picture.encoded);
    SquaredError linear = squaredError(reference.linear, picture.linear);
    PictureError error;
    error.identical = encoded.mean == 0;
    if (!error.identical) error.psnrDb = -10 * std::log10(encoded.mean);
    error.rmseLinear = std::sqrt(linear.mean);
    error.encodedRms = std::move(encoded.rootPerPixel);
    error.linearRms = std::move(linear.rootPerPixel);
    return error;
}

}  // namespace dustbench::bench
