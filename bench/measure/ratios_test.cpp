#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "bench/measure/statistics.h"
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::measure {
namespace {

constexpr int pairedExperiments = 2000;

/// A standard normal number (Box–Muller) of a simulated experiment.
double normal(std::uint32_t stream, int experiment, std::size_t serial) {
    const auto words = maths::randomWords(11, stream, serial, static_cast<std::uint32_t>(experiment));
    const double u = (words[0] + 0.5) * 0x1p-32;
    const double v = (words[1] + 0.5) * 0x1p-32;
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

struct Times {
    std::vector<double> of, with;
};

/// `pairs` rounds of two alternatives. Each round drifts by its own factor, each time scatters; the logarithm of a
/// pair's ratio has standard deviation `noise`.
Times simulatePairs(int experiment, std::size_t pairs, double ratio, double noise, double drift = 0.3) {
    Times times;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double round = 20 * std::exp(drift * normal(1, experiment, i));
        times.of.push_back(ratio * round * std::exp(noise * std::numbers::sqrt2 / 2 * normal(2, experiment, i)));
        times.with.push_back(round * std::exp(noise * std::numbers::sqrt2 / 2 * normal(3, experiment, i)));
    }
    return times;
}

template <typename Holds>
int countExperiments(std::size_t pairs, double ratio, double noise, const Holds& holds) {
    int count = 0;
    for (int experiment = 0; experiment < pairedExperiments; ++experiment) {
        const Times times = simulatePairs(experiment, pairs, ratio, noise);
        count += holds(comparePaired(times.of, times.with)) ? 1 : 0;
    }
    return count;
}

TEST(PairedRatio, QuantilesAreThoseOfPublishedTables) {
    struct Row {
        double degrees, t95, t975, t995;
    };
    for (const Row& row : {Row{1, 6.314, 12.706, 63.657}, Row{2, 2.920, 4.303, 9.925}, Row{5, 2.015, 2.571, 4.032},
                           Row{10, 1.812, 2.228, 3.169}, Row{30, 1.697, 2.042, 2.750}}) {
        EXPECT_NEAR(studentQuantile(0.95, row.degrees), row.t95, 5e-4);
        EXPECT_NEAR(studentQuantile(0.975, row.degrees), row.t975, 5e-4);
        EXPECT_NEAR(studentQuantile(0.995, row.degrees), row.t995, 5e-4);
    }
}

TEST(PairedRatio, QuantilesEqualTheClosedFormsForOneAndTwoDegrees) {
    for (double p = 0.01; p < 1; p += 0.07) {
        EXPECT_NEAR(studentQuantile(p, 1), std::tan(std::numbers::pi * (p - 0.5)), 1e-9);
        EXPECT_NEAR(studentQuantile(p, 2), (2 * p - 1) / std::sqrt(2 * p * (1 - p)), 1e-9);
    }
}

TEST(PairedRatio, EqualsTheClosedFormOfKnownLogRatios) {
    // Logarithms 0.1 ± 0.02, three of each: mean 0.1, s² = 6·0.02²/5, s/√6 = 0.02/√5.
    std::vector<double> of, with;
    for (int i = 0; i < 6; ++i) {
        with.push_back(3.0 * (i + 1));
        of.push_back(with.back() * std::exp(i % 2 ? 0.12 : 0.08));
    }
    const PairedRatio result = comparePaired(of, with);
    const double half = 2.570581835636 * 0.02 / std::sqrt(5.0);
    EXPECT_EQ(result.pairs, 6u);
    EXPECT_NEAR(result.ratio, std::exp(0.1), 1e-12);
    EXPECT_NEAR(result.low, std::exp(0.1 - half), 1e-9);
    EXPECT_NEAR(result.high, std::exp(0.1 + half), 1e-9);
    EXPECT_EQ(result.verdict, Verdict::slower);
}

TEST(PairedRatio, TheVerdictFollowsFromIntervalAndMargin) {
    const auto verdictOf = [](double low, double high) {
        // Six logarithms whose interval has exactly these ends: mean ± h, three of each, so that s/√6 = h/√5.
        const double mean = (std::log(low) + std::log(high)) / 2;
        const double h = (std::log(high) - std::log(low)) / 2 * std::sqrt(5.0) / studentQuantile(0.975, 5);
        return evaluateLogRatios(std::vector{mean - h, mean + h, mean - h, mean + h, mean - h, mean + h}).verdict;
    };
    EXPECT_EQ(verdictOf(0.90, 0.979), Verdict::faster);
    EXPECT_EQ(verdictOf(0.90, 0.982), Verdict::unresolved);
    EXPECT_EQ(verdictOf(0.981, 1.019), Verdict::same);
    EXPECT_EQ(verdictOf(1.005, 1.015), Verdict::same);
    EXPECT_EQ(verdictOf(1.019, 1.10), Verdict::unresolved);
    EXPECT_EQ(verdictOf(1.021, 1.10), Verdict::slower);
    EXPECT_EQ(verdictOf(0.90, 1.10), Verdict::unresolved);
}

TEST(PairedRatio, FewerThanSixPairsResolveNothing) {
    std::vector<double> of, with;
    for (int i = 0; i < 5; ++i) {
        of.push_back(1 + 0.001 * i);
        with.push_back(2);
        EXPECT_EQ(comparePaired(of, with).verdict, Verdict::unresolved);
    }
    const PairedRatio five = comparePaired(of, with);
    EXPECT_EQ(five.pairs, 5u);
    EXPECT_LT(five.high, 0.51);
    of.push_back(1);
    with.push_back(2);
    EXPECT_EQ(comparePaired(of, with).verdict, Verdict::faster);

    const PairedRatio one = comparePaired(std::vector{1.0}, std::vector{2.0});
    EXPECT_DOUBLE_EQ(one.ratio, 0.5);
    EXPECT_TRUE(std::isnan(one.low) && std::isnan(one.high));
    EXPECT_TRUE(std::isnan(comparePaired({}, {}).ratio));
}

TEST(PairedRatio, ExchangingTheTwoGivesTheInverse) {
    for (int experiment = 0; experiment < 200; ++experiment) {
        const Times times = simulatePairs(experiment, 6, 0.93 + 0.0007 * experiment, 0.02);
        const PairedRatio there = comparePaired(times.of, times.with);
        const PairedRatio back = comparePaired(times.with, times.of);
        EXPECT_NEAR(there.ratio * back.ratio, 1, 1e-12);
        EXPECT_NEAR(there.low * back.high, 1, 1e-12);
        EXPECT_NEAR(there.high * back.low, 1, 1e-12);
        const Verdict mirrored = there.verdict == Verdict::faster   ? Verdict::slower
                                 : there.verdict == Verdict::slower ? Verdict::faster
                                                                    : there.verdict;
        EXPECT_EQ(back.verdict, mirrored);
    }
}

TEST(PairedRatio, NeitherTheUnitNorADriftThatHitsBothMatters) {
    const Times steady = simulatePairs(3, 8, 0.9, 0.02, 0);
    const Times drifting = simulatePairs(3, 8, 0.9, 0.02, 1.0);
    Times nanoseconds = steady;
    for (std::vector<double>* times : {&nanoseconds.of, &nanoseconds.with})
        for (double& time : *times) time *= 1e6;
    const PairedRatio expected = comparePaired(steady.of, steady.with);
    for (const Times& times : {drifting, nanoseconds}) {
        const PairedRatio result = comparePaired(times.of, times.with);
        EXPECT_NEAR(result.ratio, expected.ratio, 1e-12);
        EXPECT_NEAR(result.low, expected.low, 1e-12);
        EXPECT_NEAR(result.high, expected.high, 1e-12);
    }
}

TEST(PairedRatio, TheIntervalHoldsTheTruthInNineteenOfTwenty) {
    for (const std::size_t pairs : {std::size_t{2}, std::size_t{6}, std::size_t{12}}) {
        const double trueRatio = 0.8;
        const int held = countExperiments(pairs, trueRatio, 0.1, [trueRatio](const PairedRatio& result) {
            return result.low <= trueRatio && trueRatio <= result.high;
        });
        // Three standard deviations of a binomial count of 2000 with p = 0.95 are 29.
        EXPECT_NEAR(held, 0.95 * pairedExperiments, 29) << pairs << " pairs";
    }
}

TEST(PairedRatio, AMethodAgainstItselfIsSeldomCalledFasterOrSlower) {
    const auto wrong = [](const PairedRatio& result) {
        return result.verdict == Verdict::faster || result.verdict == Verdict::slower;
    };
    for (const double noise : {0.002, 0.01, 0.02, 0.05})
        EXPECT_LE(countExperiments(6, 1, noise, wrong), pairedExperiments / 40) << noise;
    // At any noise: at most 1 of 20, plus three standard deviations of the count.
    EXPECT_LE(countExperiments(6, 1, 0.5, wrong), pairedExperiments / 20 + 29);
}

TEST(PairedRatio, SteadyTimesAreResolved) {
    const auto is = [](Verdict verdict) {
        return [verdict](const PairedRatio& result) { return result.verdict == verdict; };
    };
    EXPECT_GE(countExperiments(6, 0.9, 0.02, is(Verdict::faster)), pairedExperiments * 95 / 100);
    EXPECT_GE(countExperiments(6, 1.1, 0.02, is(Verdict::slower)), pairedExperiments * 95 / 100);
    EXPECT_GE(countExperiments(6, 1, 0.005, is(Verdict::same)), pairedExperiments * 95 / 100);
    EXPECT_GE(countExperiments(6, 1, 0.1, is(Verdict::unresolved)), pairedExperiments * 95 / 100);
}

TEST(PairedRatio, RefusesTimesThatAreNoTimes) {
    const auto messageOf = [](const std::vector<double>& of, const std::vector<double>& with) -> std::string {
        try {
            (void)comparePaired(of, with);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing thrown";
    };
    EXPECT_EQ(messageOf({1, 2}, {1}), "paired times: got 2 and 1, expected equally many");
    EXPECT_EQ(messageOf({1, 0}, {1, 1}), "paired times: got 0 in pair 1, expected a number above 0");
    EXPECT_THAT(messageOf({1}, {-3}), testing::HasSubstr("-3"));
    EXPECT_THAT(messageOf({std::nan("")}, {1}), testing::HasSubstr("nan"));
    EXPECT_THAT(messageOf({1}, {std::numeric_limits<double>::infinity()}), testing::HasSubstr("inf"));
}

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
}  // namespace dustbench::measure
