#include "bench/measure/image/flaw_metrics.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"

namespace dustbench::measure {
namespace {

constexpr double quadHalfSide = 1.5;  // of the radius

/// The first pixel at or after a coordinate, within 0..size.
int firstPixel(double coordinate, int size) {
    return static_cast<int>(std::clamp(std::ceil(coordinate - 0.5), 0.0, static_cast<double>(size)));
}

}  // namespace

std::optional<double> quadsPerPixel(std::int64_t primitives, const Plane& referenceAlpha) {
    const auto pixels = std::ranges::count_if(referenceAlpha.values, [](float alpha) { return alpha > dustAlpha; });
    if (pixels == 0) return {};
    return static_cast<double>(primitives) / static_cast<double>(pixels);
}

Plane overdrawMap(std::span<const ScreenPrimitive> primitives, int width, int height) {
    // Each quad adds ±1 at its four corners; running sums then fill it (a summed-area table).
    Plane corners(width + 1, height + 1);
    for (const ScreenPrimitive& primitive : primitives) {
        const double half = quadHalfSide * primitive.radiusPixels;
        const int x0 = firstPixel(primitive.xPixels - half, width), x1 = firstPixel(primitive.xPixels + half, width);
        const int y0 = firstPixel(primitive.yPixels - half, height), y1 = firstPixel(primitive.yPixels + half, height);
        corners.at(x0, y0) += 1;
        corners.at(x1, y0) -= 1;
        corners.at(x0, y1) -= 1;
        corners.at(x1, y1) += 1;
    }
    Plane map(width, height);
    for (int y = 0; y < height; ++y) {
        float along = 0;
        for (int x = 0; x < width; ++x) {
            along += corners.at(x, y);
            map.at(x, y) = along + (y > 0 ? map.at(x, y - 1) : 0);
        }
    }
    return map;
}

namespace quads_per_pixel_metric {

MetricGroup describe() {
    return {.metrics = {{.column = "quads_per_pixel",
                         .title = "primitives per pixel of dust",
                         .definition = "primitives drawn, divided by the number of pixels with R > 0.01",
                         .range = "0 …",
                         .unit = "1/pixel",
                         .emptyWhen = "no dust in view",
                         .perfect = "any",
                         .chartName = "primitives per pixel",
                         .isFlaw = true,
                         .needs = Needs::primitives,
                         .place = 21,
                         .round = 1}},
            .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
                return {quadsPerPixel(*moment.primitives, moment.referenceAlpha)};
            }};
}

}  // namespace quads_per_pixel_metric

}  // namespace dustbench::measure
