#include "bench/measure/cost_fit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "methods/kit/maths/philox.h"

namespace dustbench::measure {
namespace {

constexpr int repetitions = 6;

/// ms = a + b·N^k times a random factor with standard deviation `noise`.
std::vector<CostPoint> runs(double a, double b, double k, double noise = 0, std::uint32_t experiment = 0) {
    std::vector<CostPoint> points;
    for (const double load : {100.0, 200.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0, 20000.0})
        for (int repetition = 0; repetition < repetitions; ++repetition) {
            const auto words = maths::randomWords(5, 0, points.size(), experiment);
            const double u = (words[0] + 0.5) * 0x1p-32, v = (words[1] + 0.5) * 0x1p-32;
            const double normal = std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
            points.push_back({load, (a + b * std::pow(load, k)) * (1 + noise * normal)});
        }
    return points;
}

TEST(CostFit, FindsTheCurveThatThePointsLieOn) {
    for (const auto& [a, b, k] :
         {std::array{12.0, 0.002, 1.0}, std::array{0.5, 0.3, 0.5}, std::array{3.0, 1e-6, 2.1}}) {
        const CostFit fit = fitCost(runs(a, b, k));
        EXPECT_EQ(fit.reason, "");
        EXPECT_NEAR(fit.fixedMs.value / a, 1, 1e-5);
        EXPECT_NEAR(fit.factor.value / b, 1, 1e-5);
        EXPECT_NEAR(fit.exponent.value, k, 1e-6);
        EXPECT_NEAR(fit.exponent.plusMinus, 0, 1e-5);
        EXPECT_EQ(fit.loads, 8u);
        EXPECT_EQ(fit.runs, 48u);
    }
}

TEST(CostFit, IntervalsCoverTheTruthAsOftenAsTheySay) {
    constexpr int experiments = 600;
    int a = 0, b = 0, k = 0;
    for (std::uint32_t experiment = 0; experiment < experiments; ++experiment) {
        const CostFit fit = fitCost(runs(12, 0.002, 1.05, 0.03, experiment));
        ASSERT_EQ(fit.reason, "");
        a += std::abs(fit.fixedMs.value - 12) <= fit.fixedMs.plusMinus;
        b += std::abs(fit.factor.value - 0.002) <= fit.factor.plusMinus;
        k += std::abs(fit.exponent.value - 1.05) <= fit.exponent.plusMinus;
    }
    // 95 % of 600 is 570, with a standard deviation of 5.3; b loses a little coverage to the linear approximation.
    EXPECT_NEAR(a, 570, 22);
    EXPECT_NEAR(k, 570, 22);
    EXPECT_NEAR(b, 564, 28);
}

TEST(CostFit, APurePowerHasNoFixedPart) {
    const CostFit fit = fitCost(runs(0, 0.01, 0.8, 0.001, 3));
    EXPECT_EQ(fit.reason, "");
    EXPECT_NEAR(fit.fixedMs.value, 0, 0.02);
    EXPECT_NEAR(fit.exponent.value, 0.8, 3 * fit.exponent.plusMinus);
}

TEST(CostFit, DoesNotDependOnTheUnitOfTheLoad) {
    std::vector<CostPoint> points = runs(12, 0.002, 1.05, 0.03);
    const CostFit fit = fitCost(points);
    for (CostPoint& point : points) point.load /= 1000;
    const CostFit thousands = fitCost(points);
    EXPECT_NEAR(thousands.exponent.value, fit.exponent.value, 1e-6);
    EXPECT_NEAR(thousands.exponent.plusMinus, fit.exponent.plusMinus, 1e-6);
    EXPECT_NEAR(thousands.fixedMs.value, fit.fixedMs.value, 1e-5);
}

TEST(CostFit, ScatterAloneIsNoGrowth) {
    int grown = 0;
    for (std::uint32_t experiment = 0; experiment < 300; ++experiment)
        grown += fitCost(runs(12, 0, 1, 0.03, experiment)).reason.empty() ? 1 : 0;
    EXPECT_LE(grown, 30);  // the exponent is free, so slightly more than 5 %
}

TEST(CostFit, SaysWhyThereIsNone) {
    EXPECT_NE(fitCost({}).reason, "");
    EXPECT_EQ(fitCost(std::vector<CostPoint>{{1, 1}, {2, 2}, {3, 3}, {3, 3.1}}).reason, "fewer than 4 different loads");
    EXPECT_EQ(fitCost(std::vector<CostPoint>{{0, 1}, {2, 2}, {3, 3}, {4, 4}}).reason, "a load is not a number above 0");
    EXPECT_EQ(fitCost(std::vector<CostPoint>{{1, 1}, {2, -2}, {3, 3}, {4, 4}}).reason,
              "a time is not a number above 0");
    EXPECT_NE(fitCost(std::vector<CostPoint>{{1, 4}, {2, 3}, {3, 2}, {4, 1}}).reason, "");
    EXPECT_NE(fitCost(std::vector<CostPoint>{{1, 5}, {2, 5}, {3, 5}, {4, 5}}).reason, "");
}

TEST(RankCorrelation, IsOneForWhatRisesAndMinusOneForWhatFalls) {
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{1, 2}, {2, 2.1}, {3, 90}, {4, 91}}), 1);
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{4, 1}, {3, 2}, {1, 7}, {2, 3}}), -1);
}

TEST(RankCorrelation, IsOneLessFourTimesTheShareOfInversions) {
    constexpr std::size_t count = 40;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        std::vector<CostPoint> points;
        std::vector<double> list;
        for (std::size_t i = 0; i < count; ++i) {
            const double cost = maths::unitFloat(maths::randomWords(seed, 0, i)[0]);
            points.push_back({static_cast<double>(i), cost});
            list.push_back(cost);
        }
        // A bubble sort swaps neighbours once for each inversion.
        int inversions = 0;
        for (std::size_t end = count; end > 1; --end)
            for (std::size_t i = 1; i < end; ++i)
                if (list[i] < list[i - 1]) {
                    std::swap(list[i], list[i - 1]);
                    ++inversions;
                }
        EXPECT_NEAR(rankCorrelation(points), 1 - 4.0 * inversions / (count * (count - 1)), 1e-12);
    }
}

TEST(RankCorrelation, CountsTiesForNeitherSide) {
    // Pairs: (1,1)-(1,2) tied in the load, (1,2)-(2,2) tied in the cost, (1,1)-(2,2) concordant: 1/√(2·2).
    EXPECT_DOUBLE_EQ(rankCorrelation(std::vector<CostPoint>{{1, 1}, {1, 2}, {2, 2}}), 0.5);
    EXPECT_EQ(rankCorrelation(std::vector<CostPoint>{{1, 5}, {2, 5}, {3, 5}}), 0);
    EXPECT_TRUE(std::isnan(rankCorrelation(std::vector<CostPoint>{{1, 5}})));
}

}  // namespace
}  // namespace dustbench::measure
