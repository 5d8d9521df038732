// The kinds of moments against theorems, closed forms and each other, in double precision.
#include "methods/moment_oit/moment_kind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "methods/moment_oit/plain_moments.h"

namespace dustbench::moment_oit {
namespace {

const WarpedDepth range{Warp::log, 1, 40};

std::vector<Kind> kindsOf(Precision precision) {
    std::vector<Kind> kinds;
    for (const Basis basis : {Basis::power, Basis::trigonometric})
        for (const int count : {4, 6, 8}) kinds.push_back({basis, precision, count});
    return kinds;
}
std::string label(const Kind& kind) {
    return (kind.basis == Basis::power ? "power " : "trigonometric ") + std::to_string(kind.count) +
           (kind.precision == Precision::quantised ? " quantised" : "");
}

using Surfaces = std::vector<RaySurface>;

std::vector<double> totalOf(const Surfaces& surfaces, const Kind& kind) {
    std::vector<double> sum(static_cast<std::size_t>(kind.count) + 1);
    for (const RaySurface& surface : surfaces) {
        const std::vector<double> one = momentsOf(surface, range, kind);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += one[j];
    }
    return sum;
}

/// The moments as a pixel stores them: in 16 bits, rounded after each surface.
std::vector<double> storedOf(const Surfaces& surfaces, const Kind& kind) {
    if (kind.precision == Precision::single) return totalOf(surfaces, kind);
    std::vector<double> sum(static_cast<std::size_t>(kind.count) + 1);
    for (const RaySurface& surface : surfaces) {
        const std::vector<double> one = momentsOf(surface, range, kind);
        for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += one[j];
        std::vector<double> moments;
        for (std::size_t j = 1; j < sum.size(); ++j) moments.push_back(sum[j] / sum[0]);
        std::vector<double> stored = quantised(kind, moments);
        for (double& number : stored) number = std::round(number * 65535) / 65535;
        moments = dequantised(kind, stored);
        for (std::size_t j = 1; j < sum.size(); ++j) sum[j] = moments[j - 1] * sum[0];
    }
    return sum;
}

double exactBefore(const Surfaces& surfaces, double metres) {
    double depth = 0;
    for (const RaySurface& surface : surfaces) depth += surface.metres < metres ? surface.depth : 0;
    return std::exp(-depth);
}

Surfaces randomSurfaces(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> uniform(0, 1);
    Surfaces surfaces;
    for (int i = 0; i < count; ++i)
        surfaces.push_back({0.02 + 0.4 * uniform(random), std::exp(std::log(40.0) * (0.02 + 0.96 * uniform(random)))});
    return surfaces;
}

/// Moments of a measure are means of those of points, so it is enough to look at these.
TEST(MomentKind, QuantisedMomentsFillZeroToOneAndDoNotLeaveIt) {
    for (const Kind& kind : kindsOf(Precision::quantised)) {
        std::vector<double> least(static_cast<std::size_t>(kind.count), 1), most(least.size(), 0);
        for (int i = 0; i <= 20'000; ++i) {
            const double z = -1 + i / 10'000.0;
            const double metres = std::pow(40.0, 0.5 * (z + 1));
            std::vector<double> moments = momentsOf(RaySurface{1, metres}, range, kind);
            moments.erase(moments.begin());
            const std::vector<double> stored = quantised(kind, moments);
            for (std::size_t j = 0; j < stored.size(); ++j) {
                least[j] = std::min(least[j], stored[j]);
                most[j] = std::max(most[j], stored[j]);
            }
        }
        for (std::size_t j = 0; j < least.size(); ++j) {
            EXPECT_NEAR(least[j], 0, 1e-6) << label(kind) << ' ' << j;
            EXPECT_NEAR(most[j], 1, 1e-6) << label(kind) << ' ' << j;
        }
    }
}

TEST(MomentKind, DequantisingUndoesQuantising) {
    std::mt19937 random(1);
    for (const Kind& kind : kindsOf(Precision::quantised))
        for (int trial = 0; trial < 20; ++trial) {
            std::vector<double> b = totalOf(randomSurfaces(random, 5), kind);
            for (double& moment : b) moment /= b[0];
            std::vector<double> moments(b.begin() + 1, b.end());
            const std::vector<double> back = dequantised(kind, quantised(kind, moments));
            for (std::size_t j = 0; j < moments.size(); ++j) EXPECT_NEAR(back[j], moments[j], 1e-11) << label(kind);
        }
}

/// With `count` numbers, count/2 surfaces have a unique measure.
TEST(MomentKind, HalfAsManySurfacesAsNumbersAreExact) {
    const Surfaces all{{0.7, 2}, {0.4, 5}, {1.1, 12}, {0.3, 24}};
    for (const Kind& kind : kindsOf(Precision::single)) {
        const Surfaces surfaces(all.begin(), all.begin() + kind.count / 2);
        const std::vector<double> b = totalOf(surfaces, kind);
        for (std::size_t i = 0; i <= surfaces.size(); ++i) {
            const double metres = i == 0                ? 1.3
                                  : i < surfaces.size() ? std::sqrt(all[i - 1].metres * all[i].metres)
                                                        : 32;
            // 1e-10: their matrix is singular.
            EXPECT_NEAR(transmittance(b, range.at(metres), kind, 1e-10, 0.25), exactBefore(surfaces, metres), 1e-4)
                << label(kind) << ' ' << metres;
            EXPECT_NEAR(transmittance(b, range.at(metres), kind, biasOf(kind), 0.25), exactBefore(surfaces, metres),
                        5e-3)
                << label(kind) << ' ' << metres;
        }
    }
}

/// Mean of |T − exact| halfway between 12 surfaces, over 100 rays.
double meanErrorOfSurfaces(const Kind& kind, double bias) {
    std::mt19937 random(5);
    double sum = 0;
    int samples = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Surfaces surfaces = randomSurfaces(random, 12);
        const std::vector<double> b = storedOf(surfaces, kind);
        for (double z = -0.95; z < 1; z += 0.1, ++samples)
            sum +=
                std::abs(transmittance(b, z, kind, bias, 0.5) - exactBefore(surfaces, std::pow(40.0, 0.5 * (z + 1))));
    }
    return sum / samples;
}

TEST(MomentKind, ErrsLessWithMoreNumbersAndLittleMoreInSixteenBits) {
    for (const Basis basis : {Basis::power, Basis::trigonometric}) {
        double before = 1;
        for (const int count : {4, 6, 8}) {
            const Kind kind{basis, Precision::single, count}, rounded{basis, Precision::quantised, count};
            const double error = meanErrorOfSurfaces(kind, biasOf(kind));
            EXPECT_LT(error, 0.85 * before) << label(kind);
            EXPECT_NEAR(meanErrorOfSurfaces(rounded, biasOf(rounded)), error, 0.04 * error) << label(kind);
            before = error;
        }
        EXPECT_LT(before, 0.04) << static_cast<int>(basis);
    }
}

/// Both bases see the same measure from as many numbers; the circle's wrapping zone costs some of them.
TEST(MomentKind, BothBasesErrAlike) {
    for (const int count : {4, 6, 8}) {
        const Kind power{.count = count}, circle{.basis = Basis::trigonometric, .count = count};
        const double one = meanErrorOfSurfaces(power, biasOf(power)),
                     other = meanErrorOfSurfaces(circle, biasOf(circle));
        EXPECT_LT(other, 1.7 * one) << count;
        EXPECT_LT(one, 1.7 * other) << count;
    }
}

/// Rounded moments of two surfaces need not be those of any measure. Then T without a bias is arbitrary, or no number:
/// its error depends on the compiler's arithmetic, so that no factor between the two holds everywhere.
TEST(MomentKind, ABiasLimitsTheWorstErrorOfRoundingToSixteenBits) {
    std::mt19937 random(11);
    for (const Kind& kind : kindsOf(Precision::quantised)) {
        double with = 0, without = 0;
        for (int trial = 0; trial < 200; ++trial) {
            const Surfaces surfaces = randomSurfaces(random, 2);
            const std::vector<double> b = storedOf(surfaces, kind);
            for (double z = -0.95; z < 1; z += 0.1) {
                const double exact = exactBefore(surfaces, std::pow(40.0, 0.5 * (z + 1)));
                const double bare = std::abs(transmittance(b, z, kind, 0, 0.5) - exact);
                const double biased = std::abs(transmittance(b, z, kind, biasOf(kind), 0.5) - exact);
                with = std::max(with, std::isfinite(biased) ? biased : 1);
                without = std::max(without, std::isfinite(bare) ? bare : 1);
            }
        }
        EXPECT_LT(with, 0.2) << label(kind);  // close to a surface
        EXPECT_LT(with, without) << label(kind);
    }
}

/// Biased moments are those of (1 − β)·μ + β·μ*, a measure of total 1, so their bounds hold for it (Markov). Its share
/// before z is between (1 − β)·F(z) and (1 − β)·F(z) + β.
TEST(MomentKind, ABiasMovesTheBoundsByItsShareOfTheDepthAtMost) {
    std::mt19937 random(7);
    for (const int count : {4, 6, 8})
        for (const Precision precision : {Precision::single, Precision::quantised})
            for (const double bias : {1e-4, 0.01, 0.3, 0.9}) {
                const Kind kind{Basis::power, precision, count};
                for (int trial = 0; trial < 20; ++trial) {
                    const Surfaces surfaces = randomSurfaces(random, 12);
                    const std::vector<double> b = totalOf(surfaces, kind);
                    for (double z = -0.97; z < 1; z += 0.1) {
                        const double share = -std::log(exactBefore(surfaces, std::pow(40.0, 0.5 * (z + 1)))) / b[0];
                        const double least = -std::log(transmittance(b, z, kind, bias, 0)) / b[0];
                        const double most = -std::log(transmittance(b, z, kind, bias, 1)) / b[0];
                        EXPECT_LE(least, (1 - bias) * share + bias + 1e-6) << label(kind);
                        EXPECT_GE(most, (1 - bias) * share - 1e-6) << label(kind);
                    }
                }
            }
}

TEST(MomentKind, ABiasOfOneForgetsTheMomentsAndKeepsTheTotal) {
    std::mt19937 random(9);
    for (const Precision precision : {Precision::single, Precision::quantised})
        for (const Kind& kind : kindsOf(precision)) {
            const std::vector<double> one = totalOf(randomSurfaces(random, 6), kind);
            std::vector<double> other = totalOf(randomSurfaces(random, 9), kind);
            for (double& moment : other) moment *= one[0] / other[0];
            for (const double z : {-0.6, 0.1, 0.7})
                EXPECT_NEAR(transmittance(one, z, kind, 1, 0.5), transmittance(other, z, kind, 1, 0.5), 1e-9);
            EXPECT_NEAR(transmittance(one, 0.99, kind, 0, 1), std::exp(-one[0]), 0.05) << label(kind);
        }
}

}  // namespace
}  // namespace dustbench::moment_oit
