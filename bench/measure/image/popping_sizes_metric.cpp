#include "bench/measure/image/popping.h"

#include <algorithm>
#include <cmath>

#include "bench/measure/image/metric.h"

namespace dustbench::measure {
namespace {

/// Half-side of a quad in units of its primitive's radius.
constexpr double quadOfRadius = 1.5;

void addDepth(const SizedPrimitive& primitive, Plane& plane) {
    const auto [x, y, radius] = primitive.place;
    const double reach = quadOfRadius * radius;
    if (!(reach > 0)) return;
    const auto firstPixel = [](double edge, int end) { return static_cast<int>(std::clamp(edge, 0.0, 1.0 * end)); };
    const int left = firstPixel(x - reach, plane.width), right = firstPixel(x + reach + 1, plane.width);
    const int top = firstPixel(y - reach, plane.height), bottom = firstPixel(y + reach + 1, plane.height);
    for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column) {
            const double dx = column + 0.5 - x, dy = row + 0.5 - y, square = (dx * dx + dy * dy) / (radius * radius);
            if (square <= quadOfRadius * quadOfRadius)
                plane.at(column, row) += static_cast<float>(primitive.opticalDepth * std::exp(-2 * square));
        }
}

/// Sums over the pixels of one side.
struct SideSum {
    double squares = 0;
    std::size_t pixels = 0;

    [[nodiscard]] std::optional<double> rootOver(std::size_t count) const {
        if (pixels == 0) return std::nullopt;
        return std::sqrt(squares / static_cast<double>(count));
    }
};

}  // namespace

std::optional<SizeDepths> largeAmong(std::span<const SizedPrimitive> primitives, int width, int height) {
    if (primitives.empty()) return std::nullopt;
    const auto [smallest, largest] = std::ranges::minmax_element(primitives, {}, &SizedPrimitive::sizeMetres);
    if (!(largest->sizeMetres > 1.01 * smallest->sizeMetres)) return std::nullopt;
    const double border = std::sqrt(smallest->sizeMetres * largest->sizeMetres);
    SizeDepths depths{Plane(width, height), Plane(width, height)};
    for (const SizedPrimitive& primitive : primitives)
        addDepth(primitive, primitive.sizeMetres > border ? depths.large : depths.small);
    return depths;
}

PoppingBySize poppingBySize(const DustFrame& before, const DustFrame& now, const SizeDepths& depthsBefore,
                            const SizeDepths& depthsNow) {
    const Plane jumps = popping(before, now).map;
    SideSum small, large;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < jumps.values.size(); ++i) {
        if (!hasDust(before, now, i)) continue;
        ++pixels;
        const float ofSmall = depthsBefore.small.values[i] + depthsNow.small.values[i];
        const float ofLarge = depthsBefore.large.values[i] + depthsNow.large.values[i];
        if (ofSmall == 0 && ofLarge == 0) continue;
        SideSum& side = ofLarge > ofSmall ? large : small;
        side.squares += static_cast<double>(jumps.values[i]) * static_cast<double>(jumps.values[i]);
        ++side.pixels;
    }
    return {small.rootOver(small.pixels), large.rootOver(large.pixels), small.rootOver(pixels), large.rootOver(pixels)};
}

namespace popping_sizes_metric {

MetricGroup describe() {
    const auto metric = [](std::string_view column, std::string_view title, std::string_view definition,
                           std::string_view chartName, int place) {
        return Metric{.column = column,
                      .title = title,
                      .definition = definition,
                      .range = "0 … 2",
                      .unit = "encoded value",
                      .emptyWhen = "as `popping`; all primitives have one size; no pixels of a group",
                      .perfect = "0",
                      .chartName = chartName,
                      .overRun = OverRun::whole,
                      .needs = Needs::pairs,
                      .place = place,
                      .round = 5};
    };
    return {.metrics = {metric("popping_small", "popping where the smaller primitives show",
                               "`popping` over the pixels in which the smaller primitives of the method have more "
                               "optical depth; the geometric mean of its smallest and largest size separates the two "
                               "groups",
                               "popping of small primitives", 24),
                        metric("popping_large", "popping where the larger primitives show",
                               "the same for the larger primitives", "popping of large primitives", 25),
                        metric("popping_small_part",
                               "contribution of the smaller primitives' pixels to popping; the squares of both add up",
                               "contribution of the pixels of `popping_small` to `popping`: the root of their sum of "
                               "squares over the number of all pixels with dust",
                               "contribution of small primitives to popping", 26),
                        metric("popping_large_part", "contribution of the larger primitives' pixels to popping",
                               "the same for the pixels of `popping_large`",
                               "contribution of large primitives to popping", 27)},
            .ofRun = [](const PoppingOfRun& run) -> MetricGroup::Values {
                return {run.bySize.small, run.bySize.large, run.bySize.smallPart, run.bySize.largePart};
            }};
}

}  // namespace popping_sizes_metric

}  // namespace dustbench::measure
