#include "bench/measure/image/flaw_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bench/measure/image/metric.h"
#include "bench/measure/image/picture.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::measure {
namespace {

constexpr int side = 17;
constexpr double reach = 0.8;  // of the radius, to either side
constexpr double minimumRms = 0.5 / 255;
constexpr int shiftsTried = 8;
enum Stream : std::uint32_t { lotStream = 0x55e1f000, shiftStream };

using Patch = std::array<double, side * side>;

/// Bilinear between pixel centres.
double sampleAt(const Plane& plane, double x, double y) {
    const double px = x - 0.5, py = y - 0.5;
    const int x0 = std::min(static_cast<int>(px), plane.width - 2),
              y0 = std::min(static_cast<int>(py), plane.height - 2);
    const double fx = px - x0, fy = py - y0;
    const auto value = [&](int dx, int dy) { return static_cast<double>(plane.at(x0 + dx, y0 + dy)); };
    return (1 - fy) * ((1 - fx) * value(0, 0) + fx * value(1, 0)) + fy * ((1 - fx) * value(0, 1) + fx * value(1, 1));
}

/// Whether all samples lie between pixel centres.
bool isInside(const Plane& plane, const ScreenPrimitive& frame) {
    const double half = reach * frame.radiusPixels + 0.5;
    return frame.xPixels >= half && frame.yPixels >= half && frame.xPixels <= plane.width - half &&
           frame.yPixels <= plane.height - half && plane.width > 1 && plane.height > 1;
}

/// Samples with mean 0 and length 1; all 0 if there is no visible detail.
Patch patchAt(const Plane& detail, const ScreenPrimitive& frame) {
    Patch patch;
    double sum = 0, squares = 0;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const auto offset = [&](int index) { return (2.0 * index / (side - 1) - 1) * reach * frame.radiusPixels; };
            const double value = sampleAt(detail, frame.xPixels + offset(column), frame.yPixels + offset(row));
            patch[static_cast<std::size_t>(row * side + column)] = value;
            sum += value;
        }
    for (double& value : patch) {
        value -= sum / (side * side);
        squares += value * value;
    }
    const bool visible = squares >= minimumRms * minimumRms * side * side;
    for (double& value : patch) value = visible ? value / std::sqrt(squares) : 0;
    return patch;
}

/// Mean of p_i·p_j over pairs, without iterating over pairs: |Σ p|² = Σ |p|² + 2 Σ_{i<j} p_i·p_j.
class PairMean {
 public:
    void add(const Patch& patch) {
        ++count_;
        for (std::size_t i = 0; i < patch.size(); ++i) {
            sum_[i] += patch[i];
            ownSquares_ += patch[i] * patch[i];
        }
    }
    /// 0 if there are no pairs.
    [[nodiscard]] double value() const {
        if (count_ < 2) return 0;
        double squares = 0;
        for (const double value : sum_) squares += value * value;
        return (squares - ownSquares_) / (count_ * (count_ - 1));
    }

 private:
    Patch sum_{};
    double ownSquares_ = 0;
    double count_ = 0;
};

/// Indices of a random sample of at most `maximumPrimitives`, in their order.
std::vector<std::size_t> sampleOf(const Plane& detail, std::span<const ScreenPrimitive> primitives,
                                  std::uint64_t seed) {
    std::vector<std::pair<std::uint32_t, std::size_t>> lots;
    for (std::size_t i = 0; i < primitives.size(); ++i)
        if (primitives[i].radiusPixels >= minimumRadiusPixels && isInside(detail, primitives[i]))
            lots.emplace_back(maths::randomWords(seed, lotStream, i)[0], i);
    if (lots.size() > maximumPrimitives) {
        std::ranges::nth_element(lots, lots.begin() + static_cast<std::ptrdiff_t>(maximumPrimitives));
        lots.resize(maximumPrimitives);
    }
    std::vector<std::size_t> chosen;
    chosen.reserve(lots.size());
    for (const auto& [lot, index] : lots) chosen.push_back(index);
    std::ranges::sort(chosen);
    return chosen;
}

/// The primitive with its centre moved by N(0, r) (Box–Muller).
ScreenPrimitive shifted(const ScreenPrimitive& primitive, std::uint64_t seed, std::size_t index, int attempt) {
    const auto uniform = maths::uniform4(seed, shiftStream, index, static_cast<std::uint32_t>(attempt));
    const double length = primitive.radiusPixels * std::sqrt(-2 * std::log(1 - static_cast<double>(uniform[0])));
    const double angle = 2 * std::numbers::pi * static_cast<double>(uniform[1]);
    return {primitive.xPixels + length * std::cos(angle), primitive.yPixels + length * std::sin(angle),
            primitive.radiusPixels};
}

}  // namespace

Measured selfSimilarity(const Plane& alpha, const Plane& referenceAlpha, std::span<const ScreenPrimitive> primitives,
                        std::uint64_t seed) {
    requireSameSize(alpha, "the alpha", referenceAlpha, "the reference's alpha");
    Plane detail(alpha.width, alpha.height);
    Measured result{{}, Plane(alpha.width, alpha.height)};
    for (std::size_t i = 0; i < detail.values.size(); ++i) {
        detail.values[i] = alpha.values[i] - referenceAlpha.values[i];
        result.map.values[i] = std::abs(detail.values[i]);
    }
    const std::vector<std::size_t> chosen = sampleOf(detail, primitives, seed);
    if (chosen.size() < minimumPrimitives) return result;
    PairMean own, elsewhere;
    for (const std::size_t index : chosen) {
        own.add(patchAt(detail, primitives[index]));
        for (int attempt = 0; attempt < shiftsTried; ++attempt) {
            const ScreenPrimitive frame = shifted(primitives[index], seed, index, attempt);
            if (!isInside(detail, frame)) continue;
            elsewhere.add(patchAt(detail, frame));
            break;
        }
    }
    result.value = own.value() - elsewhere.value();
    return result;
}

namespace self_similarity_metric {

MetricGroup describe() {
    return {
        .metrics = {{.column = "self_similarity",
                     .title = "similarity of the primitives to each other; 0: none",
                     .definition = "mean normalised cross-correlation of α − R, sampled at 17×17 points within ±0.8 r "
                                   "of the centres of primitives, over all pairs of up to 2048 primitives, minus the "
                                   "same around centres shifted by N(0, r)",
                     .range = "−1 … 1",
                     .emptyWhen = "fewer than 8 primitives of r ≥ 4 pixels wholly in view",
                     .perfect = "0",
                     .chartName = "self-similarity",
                     .isFlaw = true,
                     .needs = Needs::primitives,
                     .place = 20,
                     .round = 1}},
        .ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
            return {selfSimilarity(moment.alpha, moment.referenceAlpha, moment.onScreen, moment.seed).value};
        }};
}

}  // namespace self_similarity_metric

}  // namespace dustbench::measure
