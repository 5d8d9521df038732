#include "bench/measure/image/picture_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "bench/measure/image/colour_spaces.h"
#include "bench/measure/image/metric.h"
#include "bench/measure/image/separable_filter.h"
#include "methods/contract/errors.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::measure {
namespace {

using std::numbers::pi;

/// One term of the eye's contrast sensitivity: a·√(π/b)·exp(−π²d²/b), d in degrees. As a Gaussian of d it has
/// σ = √(b/2)/π.
struct Sensitivity {
    double a, b;
    [[nodiscard]] double weight() const { return a * std::sqrt(pi / b); }
    [[nodiscard]] double sigmaDegrees() const { return std::sqrt(b / 2) / pi; }
};
constexpr Sensitivity achromatic{1, 0.0047}, redGreen{1, 0.0053};
constexpr Sensitivity blueYellowNarrow{34.1, 0.04}, blueYellowWide{13.5, 0.025};

constexpr double colourExponent = 0.7;         // q_c
constexpr double kneeOfColour = 0.4;           // p_c: this share of the largest difference …
constexpr double kneeOfError = 0.95;           // p_t: … is mapped to this error
constexpr double featureWidthDegrees = 0.082;  // w: peak to trough of the edge detector

/// Yy, Cx, Cz of a picture.
using Opponent = std::array<Plane, 3>;

/// `work(index)` for every pixel.
template <typename Work>
void forEachPixel(const Plane& plane, const Work& work) {
    parallel::forEachBlock(plane.values.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) work(i);
    });
}

Opponent opponentOf(const Picture& picture) {
    Opponent result;
    result.fill(Plane(picture.width, picture.height));
    forEachPixel(result[0], [&](std::size_t i) {
        const glm::vec3 rgb(picture.linear[0].values[i], picture.linear[1].values[i], picture.linear[2].values[i]);
        const glm::vec3 value = opponentFromLinear(glm::clamp(rgb, 0.0f, 1.0f));
        for (std::size_t channel = 0; channel < 3; ++channel)
            result[channel].values[i] = value[static_cast<int>(channel)];
    });
    return result;
}

/// The visible part of a picture. All kernels extend to 3σ of the widest. The blue–yellow kernel is a sum of two
/// Gaussians; each is separable, so with w their weights and S the sums of their samples along a row: k = Σ wS²·(g ⊗ g)
/// / Σ wS², with g summing to 1.
Opponent seen(const Opponent& picture, double pixelsPerDegree) {
    const int radius = static_cast<int>(std::ceil(3 * blueYellowNarrow.sigmaDegrees() * pixelsPerDegree));
    const auto kernel = [&](const Sensitivity& term) {
        return gaussianKernel<float>(term.sigmaDegrees() * pixelsPerDegree, radius);
    };
    const auto mass = [&](const Sensitivity& term) {
        const double sigma = term.sigmaDegrees() * pixelsPerDegree;
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma * sigma));
        return term.weight() * sum * sum;
    };
    const double narrow = mass(blueYellowNarrow), wide = mass(blueYellowWide);
    const auto narrowShare = static_cast<float>(narrow / (narrow + wide));
    Plane blueYellow = blur<float>(picture[2], kernel(blueYellowNarrow));
    const Plane other = blur<float>(picture[2], kernel(blueYellowWide));
    forEachPixel(blueYellow, [&](std::size_t i) {
        blueYellow.values[i] = narrowShare * blueYellow.values[i] + (1 - narrowShare) * other.values[i];
    });
    return {blur<float>(picture[0], kernel(achromatic)), blur<float>(picture[1], kernel(redGreen)),
            std::move(blueYellow)};
}

/// CIELAB with chroma scaled by lightness: colours look less colourful in the dark (Hunt effect).
glm::vec3 huntLab(glm::vec3 linear) {
    const glm::vec3 lab = labFromLinear(linear);
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

/// HyAB, raised to q_c: |ΔL| + √(Δa² + Δb²).
float colourDistance(glm::vec3 a, glm::vec3 b) {
    const float distance = std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
    return std::pow(distance, static_cast<float>(colourExponent));
}

/// ΔE_c of two blurred colours. Large differences, which few pixels have, map to the upper 5 % of the range.
float colourError(glm::vec3 referenceOpponent, glm::vec3 pictureOpponent) {
    if (referenceOpponent == pictureOpponent) return 0;  // most of a frame: saves cube roots and powers
    static const float largest = colourDistance(huntLab({0, 1, 0}), huntLab({0, 0, 1}));
    constexpr auto top = static_cast<float>(kneeOfError);
    const float kneeDistance = static_cast<float>(kneeOfColour) * largest;
    const auto lab = [](glm::vec3 value) { return huntLab(glm::clamp(linearFromOpponent(value), 0.0f, 1.0f)); };
    const float distance = colourDistance(lab(referenceOpponent), lab(pictureOpponent));
    if (distance < kneeDistance) return distance * top / kneeDistance;
    return std::min(1.0f, top + (distance - kneeDistance) / (largest - kneeDistance) * (1 - top));
}

/// Samples of a Gaussian and its first two derivatives; the positive samples of a derivative sum to 1, the negative
/// ones to −1.
struct FeatureKernels {
    std::vector<float> gauss, first, second;
};

std::vector<float> balanced(const std::vector<double>& samples) {
    double above = 0, below = 0;
    for (const double sample : samples) (sample > 0 ? above : below) += std::abs(sample);
    std::vector<float> kernel;
    kernel.reserve(samples.size());
    for (const double sample : samples) kernel.push_back(static_cast<float>(sample / (sample > 0 ? above : below)));
    return kernel;
}

FeatureKernels featureKernels(double pixelsPerDegree) {
    const double sigma = featureWidthDegrees / 2 * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> first, second;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / sigma, gauss = std::exp(-0.5 * x * x);
        first.push_back(-x * gauss);
        second.push_back((x * x - 1) * gauss);
    }
    return {gaussianKernel<float>(sigma, radius), balanced(first), balanced(second)};
}

/// Lengths of the gradient (edges) and of the second derivatives (points) of brightness, which ranges from 0 to 1.
struct Features {
    Plane edge, point;
};

Features featuresOf(const Plane& luminance, const FeatureKernels& kernels) {
    Plane brightness = luminance;
    forEachPixel(brightness, [&](std::size_t i) { brightness.values[i] = (luminance.values[i] + 16) / 116; });
    const Plane smoothRows = filterRows<float>(brightness, kernels.gauss);
    const auto along = [&](const std::vector<float>& derivative) {
        Plane length = filterColumns<float>(filterRows<float>(brightness, derivative), kernels.gauss);
        const Plane down = filterColumns<float>(smoothRows, derivative);
        forEachPixel(length, [&](std::size_t i) {
            const float x = length.values[i], y = down.values[i];
            length.values[i] = std::sqrt(x * x + y * y);
        });
        return length;
    };
    return {along(kernels.first), along(kernels.second)};
}

}  // namespace

Measured flip(const Picture& reference, const Picture& picture, double pixelsPerDegree) {
    requireSameSize(reference, picture);
    if (!(pixelsPerDegree >= minimumPixelsPerDegree && pixelsPerDegree <= maximumPixelsPerDegree))
        throw InputError(fmt::format("pixels per degree: got {}, allowed: {}..{}", pixelsPerDegree,
                                     minimumPixelsPerDegree, maximumPixelsPerDegree));
    const Opponent referenceColours = opponentOf(reference), pictureColours = opponentOf(picture);
    const Opponent referenceSeen = seen(referenceColours, pixelsPerDegree);
    const Opponent pictureSeen = seen(pictureColours, pixelsPerDegree);
    const FeatureKernels kernels = featureKernels(pixelsPerDegree);
    const Features r = featuresOf(referenceColours[0], kernels), p = featuresOf(pictureColours[0], kernels);

    Measured result{{}, Plane(reference.width, reference.height)};
    const auto colour = [](const Opponent& planes, std::size_t i) {
        return glm::vec3(planes[0].values[i], planes[1].values[i], planes[2].values[i]);
    };
    forEachPixel(result.map, [&](std::size_t i) {
        const float edges = std::abs(r.edge.values[i] - p.edge.values[i]);
        const float points = std::abs(r.point.values[i] - p.point.values[i]);
        // The exponent q_f is 1/2.
        const float features = std::sqrt(std::max(edges, points) / std::numbers::sqrt2_v<float>);
        const float colours = colourError(colour(referenceSeen, i), colour(pictureSeen, i));
        result.map.values[i] = std::pow(colours, std::max(0.0f, 1 - features));
    });
    result.value = std::accumulate(result.map.values.begin(), result.map.values.end(), 0.0) /
                   static_cast<double>(result.map.values.size());
    return result;
}

namespace flip_metric {

MetricGroup describe() {
    const auto ofMoment = [](const ComparedMoment& moment) -> MetricGroup::Values {
        return {moment.flip.value, meanWithin(moment.flip.map, moment.mask)};
    };
    return {
        .metrics = {{.column = "flip",
                     .title = "difference that a viewer sees when flipping to the reference image; 0: none",
                     .definition = "mean of the FLIP map (low dynamic range), by default at 67.02 pixels per degree",
                     .range = "0 … 1",
                     .source = "Andersson2020",
                     .perfect = "0",
                     .chartName = "FLIP",
                     .place = 3,
                     .round = 1},
                    {.column = "flip_mask",
                     .title = "flip within the pixels that contain dust in either picture",
                     .definition = "mean of the same map within the mask",
                     .range = "0 … 1",
                     .emptyWhen = "no dust in view",
                     .source = "Andersson2020",
                     .perfect = "0",
                     .chartName = "FLIP within the mask",
                     .ranks = true,
                     .place = 4,
                     .round = 3}},
        .ofMoment = ofMoment};
}

}  // namespace flip_metric

}  // namespace dustbench::measure
