#include "bench/measure/image/picture_error.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"

namespace dustbench::measure {
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

namespace picture_error_metric {

MetricGroup describe() {
    const auto ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
        const PictureError error = pictureError(moment.reference, moment.picture);
        const auto& continuum = moment.continuumPicture;
        return {error.psnrDb, error.identical ? 1.0 : 0.0, error.rmseLinear,
                continuum ? pictureError(*continuum, moment.picture).psnrDb : std::nullopt};
    };
    return {
        .metrics = {{.column = "psnr_db",
                     .title = "peak signal-to-noise ratio against the reference image, dB",
                     .definition = "−10 log₁₀ of the mean squared error over the three channels",
                     .range = "0 …",
                     .unit = "dB",
                     .emptyWhen = "identical",
                     .perfect = "identical",
                     .higherIsBetter = true,
                     .chartName = "PSNR",
                     .place = 1,
                     .round = 1},
                    {.column = "identical",
                     .title = "1: every compared picture equals its reference image",
                     .definition = "1: no encoded value differs",
                     .range = "0, 1",
                     .perfect = "1",
                     .higherIsBetter = true,
                     .overRun = OverRun::all,
                     .place = 11,
                     .round = 1},
                    {.column = "rmse_linear",
                     .title = "root of the mean squared difference of linear light",
                     .definition = "root of the mean squared error over the three linear channels, without clamping",
                     .range = "0 …",
                     .unit = "linear light",
                     .perfect = "0",
                     .chartName = "RMSE",
                     .place = 10,
                     .round = 1},
                    {.column = "psnr_continuum_db",
                     .title = "psnr_db against a reference with 64 times as many particles, dB",
                     .definition = "`psnr_db` against the continuum",
                     .range = "0 …",
                     .unit = "dB",
                     .emptyWhen = "identical, or the dust is lit or has several colours",
                     .perfect = "identical",
                     .higherIsBetter = true,
                     .chartName = "PSNR against the continuum",
                     .needs = Needs::continuumPicture,
                     .place = 14,
                     .round = 2}},
        .ofMoment = ofMoment};
}

}  // namespace picture_error_metric

}  // namespace dustbench::measure
