// Checks the plain moments against quadrature, theorems about moments, and the closed-form transmittance.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/moment_oit/plain_moments.h"

namespace dustbench::moment_oit {
namespace {

using Ray = std::vector<RayPuff>;

/// Puffs along one ray, some limited by eye or scene.
Ray randomRay(std::mt19937& random, int count, double sceneMetres) {
    std::uniform_real_distribution<double> uniform(0, 1);
    Ray ray;
    for (int i = 0; i < count; ++i)
        ray.push_back(
            {0.02 + 0.4 * uniform(random), 2 + 38 * uniform(random), 0.12 + 0.7 * uniform(random), 0, sceneMetres});
    return ray;
}

double depthBefore(const Ray& ray, double metres) {
    double depth = 0;
    for (const RayPuff& puff : ray) {
        const double width = std::sqrt(2.0) * puff.deviationMetres, to = std::min(metres, puff.endMetres);
        if (to <= puff.beginMetres) continue;
        depth += puff.whole * 0.5 *
                 (std::erf((to - puff.footMetres) / width) - std::erf((puff.beginMetres - puff.footMetres) / width));
    }
    return depth;
}

std::vector<double> sumOf(const Ray& ray, const WarpedDepth& depth, const Kind& kind, bool asPoint) {
    std::vector<double> sum(static_cast<std::size_t>(kind.count) + 1);
    for (const RayPuff& puff : ray) {
        const Profile profile = profileOf(puff);
        const std::vector<double> one = asPoint ? momentsOf(RaySurface{profile.depth, profile.meanMetres}, depth, kind)
                                                : momentsOf(puff, depth, kind);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += one[j];
    }
    return sum;
}

TEST(Moments, OfAPuffEqualTheIntegralAlsoWhereEyeAndSceneCutIt) {
    const WarpedDepth depth{Warp::linear, 1, 21};
    for (const RayPuff& puff : {RayPuff{0.7, 9, 0.5}, RayPuff{0.3, 0.2, 0.6}, RayPuff{0.4, 8, 0.8, 0, 8.3},
                                RayPuff{0.4, 8, 0.5, 0, 6.8}, RayPuff{2, -0.3, 0.7, 0, 0.8}}) {
        const std::vector<double> b = momentsOf(puff, depth, Kind{.count = 6});
        const double from = std::max(puff.beginMetres, puff.footMetres - 8 * puff.deviationMetres);
        const double to = std::min(puff.endMetres, puff.footMetres + 8 * puff.deviationMetres);
        const int steps = 20'000;
        std::vector<double> integral(7);
        for (int k = 0; k < steps; ++k) {
            const double t = from + (k + 0.5) * (to - from) / steps;
            const double x = (t - puff.footMetres) / puff.deviationMetres;
            const double sigma =
                puff.whole / (std::sqrt(2 * 3.14159265358979) * puff.deviationMetres) * std::exp(-x * x / 2);
            for (int j = 0; j < 7; ++j)
                integral[static_cast<std::size_t>(j)] += sigma * std::pow(depth.at(t), j) * (to - from) / steps;
        }
        for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(b[j], integral[j], 1e-6) << puff.footMetres << ' ' << j;
    }
}

TEST(Moments, ReconstructAsManySurfacesAsTheyAreTwice) {
    const WarpedDepth depth{Warp::log, 1, 40};
    const std::vector<double> places{3, 9, 25}, depths{0.7, 0.4, 1.1};
    for (const int count : {4, 6}) {
        Ray ray;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count) / 2; ++i)
            ray.push_back({depths[i], places[i], 1e-4});
        const std::vector<double> b = sumOf(ray, depth, {.count = count}, true);
        double before = 0;
        for (std::size_t i = 0; i <= ray.size(); ++i) {
            const double metres = i == 0 ? 2 : i < ray.size() ? 0.5 * (places[i - 1] + places[i]) : 38;
            // 1e-10: their matrix is singular.
            EXPECT_NEAR(transmittance(b, depth.at(metres), {.count = count}, 1e-10, 0.25), std::exp(-before), 2e-4)
                << count << ' ' << metres;
            EXPECT_NEAR(transmittance(b, depth.at(metres), {.count = count}, biasOf({.count = count}), 0.25),
                        std::exp(-before), 0.03)
                << count;
            if (i < ray.size()) before += depths[i];
        }
    }
}

TEST(Moments, OneSurfaceDimsWhatLiesBehindItAndNothingBefore) {
    const WarpedDepth depth{Warp::log, 1, 40};
    const std::vector<double> b = sumOf({{1.5, 8, 1e-4}}, depth, {.count = 4}, true);
    EXPECT_NEAR(transmittance(b, depth.at(7), {.count = 4}, biasOf({.count = 4}), 0.25), 1, 2e-3);
    EXPECT_NEAR(transmittance(b, depth.at(9.5), {.count = 4}, biasOf({.count = 4}), 0.25), std::exp(-1.5), 2e-3);
}

/// Markov's theorem: with the exact moments of a measure and no bias, T never lies outside the bounds.
TEST(Moments, BoundTheTransmittanceFromBothSides) {
    std::mt19937 random(3);
    const WarpedDepth depth{Warp::linear, 0, 44};
    for (const int count : {4, 6})
        for (int trial = 0; trial < 40; ++trial) {
            const Ray ray = randomRay(random, 8, trial % 2 ? 1e9 : 25);
            const std::vector<double> b = sumOf(ray, depth, {.count = count}, false);
            for (double metres = 1; metres < 44; metres += 0.7) {
                const double exact = std::exp(-depthBefore(ray, metres));
                const double high = transmittance(b, depth.at(metres), {.count = count}, 0, 0),
                             low = transmittance(b, depth.at(metres), {.count = count}, 0, 1);
                EXPECT_LE(exact, high + 1e-6);
                EXPECT_GE(exact, low - 1e-6);
            }
        }
}

/// Mean of |T − exact| along 200 rays through 8 puffs, with the bias of single precision.
double meanError(int count, bool asPoint, double overestimation) {
    std::mt19937 random(5);
    const WarpedDepth depth{Warp::log, 1, 44};
    double sum = 0;
    int samples = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Ray ray = randomRay(random, 8, 1e9);
        const std::vector<double> b = sumOf(ray, depth, {.count = count}, asPoint);
        for (double metres = 1; metres < 44; metres += 0.7, ++samples)
            sum += std::abs(
                transmittance(b, depth.at(metres), {.count = count}, biasOf({.count = count}), overestimation) -
                std::exp(-depthBefore(ray, metres)));
    }
    return sum / samples;
}

TEST(Moments, ComeCloseToTheTransmittanceOfPuffs) {
    const double four = meanError(4, false, 0.5), six = meanError(6, false, 0.5);
    EXPECT_LT(four, 0.04);
    EXPECT_LT(six, 0.8 * four);
    // The transmittance of a medium lies halfway between the bounds; the paper's 0.25 is for surfaces.
    EXPECT_LT(six, 0.8 * meanError(6, false, 0.25));
}

/// Thick, overlapping puffs: here a puff differs from a point.
TEST(Moments, OfPuffsAreBetterThanOfPointsWherePuffsAreWide) {
    const WarpedDepth depth{Warp::log, 1, 30};
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(0, 1);
    double puffs = 0, points = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Ray ray{{1 + uniform(random), 6 + 4 * uniform(random), 1.5}, {0.5, 12 + 6 * uniform(random), 2}};
        const std::vector<double> own = sumOf(ray, depth, {.count = 6}, false),
                                  asPoint = sumOf(ray, depth, {.count = 6}, true);
        for (double metres = 2; metres < 25; metres += 0.5) {
            const double exact = std::exp(-depthBefore(ray, metres));
            puffs += std::abs(transmittance(own, depth.at(metres), {.count = 6}, biasOf({.count = 6}), 0.5) - exact);
            points +=
                std::abs(transmittance(asPoint, depth.at(metres), {.count = 6}, biasOf({.count = 6}), 0.5) - exact);
        }
    }
    EXPECT_LT(puffs, 0.5 * points);
}

}  // namespace
}  // namespace dustbench::moment_oit
