#include "bench/measure/ratio_of_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "bench/measure/paired_ratio.h"

namespace dustbench::bench {
namespace {

using Pairs = std::vector<std::pair<double, double>>;

TEST(RatioOfMeans, OfEqualsIsOneWhateverTheirNoise) {
    const RatioOfMeans equal =
        ratioOfMeans(Pairs{{1.2, 1.2}, {2.7, 2.7}, {2.2, 2.2}, {1.0, 1.0}, {-0.2, -0.2}, {1.1, 1.1}}, 0.95);
    EXPECT_NEAR(equal.ratio, 1, 1e-12);
    EXPECT_NEAR(equal.low, 1, 1e-9);
    EXPECT_NEAR(equal.high, 1, 1e-9);
}

TEST(RatioOfMeans, IsUnboundedWhereTheDenominatorIsNotToldFromZero) {
    const RatioOfMeans open = ratioOfMeans(Pairs{{3, 0.5}, {3, -0.4}, {3, 0.6}, {3, -0.5}, {3, 0.1}, {3, 0.1}}, 0.95);
    EXPECT_TRUE(std::isfinite(open.ratio));
    EXPECT_TRUE(std::isnan(open.low) && std::isnan(open.high));
    EXPECT_TRUE(std::isnan(ratioOfMeans({}, 0.95).ratio));
    EXPECT_TRUE(std::isnan(ratioOfMeans(Pairs{{1, 2}}, 0.95).low));
}

TEST(RatioOfMeans, WithAConstantDenominatorIsStudentsInterval) {
    const std::vector<double> x{4, 5, 7, 4, 6};
    Pairs pairs;
    for (const double value : x) pairs.emplace_back(value, 2);
    // Mean 5.2, variance 1.7.
    const double half = studentQuantile(0.975, 4) * std::sqrt(1.7 / 5) / 2;
    const RatioOfMeans found = ratioOfMeans(pairs, 0.95);
    EXPECT_NEAR(found.low, 2.6 - half, 1e-12);
    EXPECT_NEAR(found.high, 2.6 + half, 1e-12);
}

TEST(RatioOfMeans, TheEndsAreWhereStudentsTestTurns) {
    const Pairs pairs{{4.1, 1.2}, {5.3, 2.9}, {3.2, -0.1}, {6.6, 2.0}, {4.8, 1.1}, {5.1, 1.9}, {4.0, 1.6}};
    const RatioOfMeans found = ratioOfMeans(pairs, 0.9);
    for (const double end : {found.low, found.high}) {
        double mean = 0, squares = 0;
        for (const auto& [x, y] : pairs) mean += (x - end * y) / 7;
        for (const auto& [x, y] : pairs) squares += std::pow(x - end * y - mean, 2);
        EXPECT_NEAR(std::abs(mean) / std::sqrt(squares / 6 / 7), studentQuantile(0.95, 6), 1e-9);
    }
}

TEST(RatioOfMeans, TheIntervalHoldsTheTruthAsOftenAsItSays) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal;
    constexpr int trials = 4000;
    int held = 0;
    for (int trial = 0; trial < trials; ++trial) {
        Pairs pairs;
        for (int i = 0; i < 8; ++i) {
            const double shared = normal(random);
            pairs.emplace_back(2 + 0.5 * shared + 0.3 * normal(random), 1 + 0.4 * shared + 0.2 * normal(random));
        }
        const RatioOfMeans found = ratioOfMeans(pairs, 0.95);
        held += std::isnan(found.low) || (found.low <= 2 && 2 <= found.high);
    }
    EXPECT_NEAR(held / static_cast<double>(trials), 0.95, 0.0104);  // three standard errors
}

}  // namespace
}  // namespace dustbench::bench
