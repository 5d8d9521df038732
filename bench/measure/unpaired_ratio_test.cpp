#include "bench/measure/unpaired_ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "methods/kit/maths/philox.h"

namespace dustbench::bench {
namespace {

constexpr int experiments = 10'000;

/// `count` normal logarithms (Box–Muller) of a simulated experiment.
std::vector<double> simulate(std::uint32_t stream, int experiment, std::size_t count, double mean, double deviation) {
    std::vector<double> logs(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto words = maths::randomWords(17, stream, i, static_cast<std::uint32_t>(experiment));
        const double u = (words[0] + 0.5) * 0x1p-32, v = (words[1] + 0.5) * 0x1p-32;
        logs[i] = mean + deviation * std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
    }
    return logs;
}

struct Design {
    std::size_t n, m;
    double ofDeviation, withDeviation;
};

template <typename Holds>
double shareOfExperiments(const Design& design, double logRatio, const Holds& holds) {
    int count = 0;
    for (int experiment = 0; experiment < experiments; ++experiment)
        count += holds(compareUnpairedLogs(simulate(1, experiment, design.n, 3 + logRatio, design.ofDeviation),
                                           simulate(2, experiment, design.m, 3, design.withDeviation)));
    return static_cast<double>(count) / experiments;
}

TEST(UnpairedRatio, EqualsTheClosedFormOfKnownLogarithms) {
    // Three times mean ± d: s²/6 = d²/5. With d = 0.02 and 0.04, ν = (4 + 16)²/(4² + 16²)·5.
    std::vector<double> of, with;
    for (int i = 0; i < 6; ++i) {
        of.push_back(1.1 + (i % 2 ? 0.02 : -0.02));
        with.push_back(1.0 + (i % 2 ? 0.04 : -0.04));
    }
    const UnpairedRatio result = compareUnpairedLogs(of, with);
    EXPECT_NEAR(result.degreesOfFreedom, 400.0 / 272 * 5, 1e-9);
    const double half = studentQuantile(0.975, 400.0 / 272 * 5) * std::sqrt((0.0004 + 0.0016) / 5);
    EXPECT_NEAR(result.ratio, std::exp(0.1), 1e-12);
    EXPECT_NEAR(result.low, std::exp(0.1 - half), 1e-12);
    EXPECT_NEAR(result.high, std::exp(0.1 + half), 1e-12);
    EXPECT_EQ(result.verdict, Verdict::slower);
    EXPECT_EQ(compareUnpairedLogs(with, of).verdict, Verdict::faster);
}

TEST(UnpairedRatio, OfEqualSizesAndScatterItIsStudentsTestOfTwoMeans) {
    const std::vector<double> of{0.0, 0.1, 0.2, 0.3}, with{1.0, 1.1, 1.2, 1.3};
    EXPECT_NEAR(compareUnpairedLogs(of, with).degreesOfFreedom, 6, 1e-9);
}

TEST(UnpairedRatio, TheOrderOfTheTimesDoesNotMatter) {
    const std::vector<double> of = simulate(1, 5, 8, 0, 0.1), with = simulate(2, 5, 6, 0, 0.3);
    const std::vector<double> backwards(of.rbegin(), of.rend());
    EXPECT_NEAR(compareUnpairedLogs(of, with).low, compareUnpairedLogs(backwards, with).low, 1e-12);
}

TEST(UnpairedRatio, TheIntervalHoldsTheTruthInNineteenOfTwenty) {
    const double trueRatio = std::log(1.05);
    for (const Design& design : {Design{6, 6, 0.03, 0.03}, Design{6, 6, 0.03, 0.12}, Design{6, 6, 0.001, 0.1},
                                 Design{6, 20, 0.1, 0.02}, Design{20, 6, 0.1, 0.02}, Design{40, 10, 0.05, 0.05}}) {
        const double held = shareOfExperiments(design, trueRatio, [trueRatio](const UnpairedRatio& result) {
            return std::log(result.low) <= trueRatio && trueRatio <= std::log(result.high);
        });
        // Welch's interval is an approximation: its coverage is within 0.5 % of 95 % for six times or more, and three
        // standard deviations of a share of 10,000 are 0.65 %.
        EXPECT_NEAR(held, 0.95, 0.0115) << design.n << " " << design.m << " " << design.withDeviation;
    }
}

TEST(UnpairedRatio, PoolingTheScatterWouldNotHoldTheTruth) {
    // Why Welch's interval and not the pooled Student interval: with few noisy times against many steady ones, the
    // pooled deviation is far too small.
    int held = 0;
    for (int experiment = 0; experiment < experiments; ++experiment) {
        const std::vector<double> of = simulate(1, experiment, 6, 0, 0.1), with = simulate(2, experiment, 20, 0, 0.02);
        const auto squares = [](const std::vector<double>& x, double& mean) {
            mean = 0;
            for (const double value : x) mean += value / static_cast<double>(x.size());
            double sum = 0;
            for (const double value : x) sum += (value - mean) * (value - mean);
            return sum;
        };
        double x = 0, y = 0;
        const double pooled = (squares(of, x) + squares(with, y)) / 24;
        held += std::abs(x - y) <= studentQuantile(0.975, 24) * std::sqrt(pooled * (1.0 / 6 + 1.0 / 20));
    }
    EXPECT_LT(held, 0.85 * experiments);
}

TEST(UnpairedRatio, EqualSessionsAreSeldomCalledFasterOrSlower) {
    const auto wrong = [](const UnpairedRatio& result) {
        return result.verdict == Verdict::faster || result.verdict == Verdict::slower;
    };
    EXPECT_LE(shareOfExperiments({6, 6, 0.02, 0.02}, 0, wrong), 1.0 / 40);
    EXPECT_LE(shareOfExperiments({6, 6, 0.5, 0.5}, 0, wrong), 1.0 / 20 + 0.0065);
}

TEST(UnpairedRatio, TooFewTimesResolveNothing) {
    const std::vector<double> five{1, 1.001, 1, 1.001, 1}, six{2, 2.001, 2, 2.001, 2, 2.001};
    EXPECT_EQ(compareUnpairedLogs(five, six).verdict, Verdict::unresolved);
    EXPECT_EQ(compareUnpairedLogs(six, five).verdict, Verdict::unresolved);
    EXPECT_GT(compareUnpairedLogs(six, five).low, 2.6);
    EXPECT_EQ(compareUnpairedLogs(six, six).verdict, Verdict::same);
    const UnpairedRatio one = compareUnpairedLogs(six, std::vector{1.0});
    EXPECT_FALSE(std::isnan(one.ratio));
    EXPECT_TRUE(std::isnan(one.low));
    EXPECT_TRUE(std::isnan(compareUnpairedLogs({}, six).ratio));
}

TEST(UnpairedRatio, TimesThatDoNotScatterHaveAPointForAnInterval) {
    const std::vector<double> of(6, 0.5), with(6, 0.0);
    const UnpairedRatio result = compareUnpairedLogs(of, with);
    EXPECT_DOUBLE_EQ(result.low, std::exp(0.5));
    EXPECT_DOUBLE_EQ(result.high, std::exp(0.5));
    EXPECT_EQ(result.verdict, Verdict::slower);
}

}  // namespace
}  // namespace dustbench::bench
