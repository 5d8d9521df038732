#include "methods/wavelet_oit/plain_wavelets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace dustbench::wavelet_oit {
namespace {

/// A puff's part of A at z.
double depthAt(const Part& part, double z) {
    if (part.width == 0) return z > part.at ? part.depth : 0;
    const double x = std::clamp((z - part.centre) / part.width, part.begin, part.end);
    return part.whole / 2 * (std::erf(x) - std::erf(part.begin));
}

Part volume(double whole, double centre, double width, double begin = -6, double end = 6) {
    return {whole / 2 * (std::erf(end) - std::erf(begin)), centre, centre, width, whole, begin, end};
}

std::vector<Part> randomSurfaces(int count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Part> parts;
    parts.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) parts.push_back({4 * uniform(random) / count, uniform(random)});
    return parts;
}

std::vector<double> sumsOf(const std::vector<Part>& parts, int rank) {
    std::vector<double> sums(std::size_t{2} << rank);
    for (const Part& part : parts) {
        const std::vector<double> one = coefficientsOf(part, rank);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += one[i];
    }
    return sums;
}

/// Mean over the puffs of |A in front of a puff − that of the nearer puffs|.
double meanError(const std::vector<Part>& parts, int rank) {
    const std::vector<double> sums = sumsOf(parts, rank);
    double error = 0;
    for (const Part& own : parts) {
        double exact = 0;
        for (const Part& other : parts)
            if (other.at < own.at) exact += other.depth;
        error += std::abs(depthBefore(sums, own) - exact);
    }
    return error / static_cast<double>(parts.size());
}

TEST(PlainWavelets, HasTheCoefficientsOfNumericalIntegrals) {
    constexpr int rank = 3, steps = 1 << 16;
    const std::vector<Part> parts{{0.7, 0.3},
                                  {1.5, 0.71},
                                  volume(1.2, 0.4, 0.2),
                                  volume(0.6, 0.9, 0.01),
                                  volume(2, 0.3, 0.3, -0.4, 1.1),
                                  volume(2, -0.1, 0.2, 0.1)};
    for (const Part& part : parts) {
        const std::vector<double> coefficients = coefficientsOf(part, rank);
        std::vector<double> numerical(coefficients.size());
        for (int i = 0; i < steps; ++i) {
            const double z = (i + 0.5) / steps, depth = depthAt(part, z) / steps;
            numerical[0] += depth;
            for (std::size_t wavelets = 1; wavelets < numerical.size(); wavelets *= 2) {
                const double place = z * static_cast<double>(wavelets), k = std::floor(place);
                const double psi = std::sqrt(static_cast<double>(wavelets)) * (place - k < 0.5 ? 1 : -1);
                numerical[wavelets + static_cast<std::size_t>(k)] -= psi * depth;
            }
        }
        for (std::size_t i = 0; i < coefficients.size(); ++i)
            EXPECT_NEAR(coefficients[i], numerical[i], 1e-4 * part.depth) << i;
    }
}

TEST(PlainWavelets, HasTheMeansOfTheOpticalDepthOverItsCells) {
    const std::vector<Part> parts{{0.7, 0.3}, volume(1.2, 0.4, 0.2, -1, 0.5), volume(0.6, 0.8, 0.05)};
    for (const int rank : {0, 2, 3, 4}) {
        const std::vector<double> sums = sumsOf(parts, rank);
        const auto cells = static_cast<double>(sums.size());
        for (std::size_t cell = 0; cell < sums.size(); ++cell) {
            double mean = 0;
            for (const Part& part : parts) {
                const double from = static_cast<double>(cell) / cells, to = static_cast<double>(cell + 1) / cells;
                mean += cells * (integralTo(part, to) - integralTo(part, from));
            }
            EXPECT_NEAR(meanOver(sums, cell), mean, 1e-12) << rank << ' ' << cell;
        }
    }
}

TEST(PlainWavelets, HasNoNegativeCoefficientAndTheTotalInItsLastCell) {
    for (const int rank : {2, 3, 4, 7}) {
        std::vector<Part> parts = randomSurfaces(50, 1);
        const double last = 1 - 1.0 / static_cast<double>(std::size_t{2} << rank);
        double total = 0;
        for (Part& part : parts) part.at *= last, total += part.depth;
        const std::vector<double> sums = sumsOf(parts, rank);
        for (const double one : sums) EXPECT_GE(one, -1e-15);
        EXPECT_NEAR(meanOver(sums, sums.size() - 1), total, 1e-12);
    }
}

TEST(PlainWavelets, ANarrowVolumeIsASurface) {
    const Part surface{1.3, 0.36}, narrow = volume(1.3, 0.36, 1e-6);
    const std::vector<double> one = coefficientsOf(surface, 4), other = coefficientsOf(narrow, 4);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-6);
}

TEST(PlainWavelets, OneAloneHasNothingInFront) {
    for (const Part& part : {Part{1.3, 0.36}, Part{4, 0}, Part{2, 1}, volume(1.2, 0.4, 0.2), volume(3, 0.6, 0.1, 0, 2)})
        for (const int rank : {2, 3, 4}) EXPECT_NEAR(depthBefore(coefficientsOf(part, rank), part), 0, 1e-12);
}

/// Means lag behind by half a cell in dense dust, so the order is 1. Few puffs get cells of their own at a fine rank.
TEST(PlainWavelets, ConvergesToTheExactOpticalDepthInFront) {
    const std::vector<Part> many = randomSurfaces(400, 2), few = randomSurfaces(12, 3);
    for (const int rank : {2, 3, 4, 5}) {
        const double ratio = meanError(many, rank) / meanError(many, rank + 1);
        EXPECT_NEAR(ratio, 2, 0.25) << rank;
    }
    EXPECT_GT(meanError(few, 3), 1e-3);
    EXPECT_LT(meanError(few, 14), 1e-9);
}

}  // namespace
}  // namespace dustbench::wavelet_oit
