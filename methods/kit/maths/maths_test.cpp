#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "methods/kit/maths/bezier.h"
#include "methods/kit/maths/fast_functions.h"
#include "methods/kit/maths/hash.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::maths {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Random123's known-answer tests for philox4x32-10: (counter, key) → words. The counter is (serial, stream, draw).
TEST(Philox, GivesTheKnownAnswers) {
    EXPECT_EQ(randomWords(0, 0, 0, 0), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(randomWords(~0ULL, ~0U, ~0ULL, ~0U), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(randomWords(0x299f31d0a4093822, 0x13198a2e, 0x85a308d3243f6a88, 0x03707344),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, UnitFloatsStayBelowOne) {
    EXPECT_EQ(unitFloat(0), 0.0f);
    EXPECT_LT(unitFloat(~0U), 1.0f);
    EXPECT_EQ(unitFloat(0x80000000U), 0.5f);
    EXPECT_EQ(centred(0.0f), -1.0f);
}

// χ² over 256 bins, 255 degrees of freedom: 330.5 is exceeded with probability 0.001. The seed is fixed.
TEST(Philox, FillsBinsEvenlyOverSerialsStreamsAndDraws) {
    constexpr int count = 1 << 18, bins = 256;
    const auto chiSquare = [](const std::function<float(std::uint32_t)>& sample) {
        std::vector<int> filled(bins);
        for (std::uint32_t i = 0; i < count; ++i) ++filled[static_cast<std::size_t>(sample(i) * bins)];
        constexpr double expected = count / double{bins};
        double sum = 0;
        for (const int n : filled) sum += (n - expected) * (n - expected) / expected;
        return sum;
    };
    for (std::size_t word = 0; word < 4; ++word) {
        EXPECT_LT(chiSquare([&](std::uint32_t i) { return uniform4(7, 1, i)[word]; }), 330.5);
        EXPECT_LT(chiSquare([&](std::uint32_t i) { return uniform4(7, i, 3)[word]; }), 330.5);
        EXPECT_LT(chiSquare([&](std::uint32_t i) { return uniform4(7, 1, 3, i)[word]; }), 330.5);
        EXPECT_LT(chiSquare([&](std::uint32_t i) { return uniform4(i, 1, 3)[word]; }), 330.5);
    }
}

TEST(Philox, SerialsAndWordsAreUncorrelated) {
    constexpr int count = 1 << 16;
    double neighbours = 0, words = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto a = uniform4(11, 2, i), b = uniform4(11, 2, i + 1);
        neighbours += static_cast<double>(centred(a[0])) * static_cast<double>(centred(b[0]));
        words += static_cast<double>(centred(a[0])) * static_cast<double>(centred(a[1]));
    }
    // Each product has variance 1/9; 3.3 standard deviations are exceeded with probability 0.001.
    const double limit = 3.3 * std::sqrt(count / 9.0);
    EXPECT_LT(std::abs(neighbours), limit);
    EXPECT_LT(std::abs(words), limit);
}

TEST(Sine, StaysWithinItsStatedErrorOfTheTrueSine) {
    double worst = 0;
    for (int i = -400000; i <= 400000; ++i) {
        const float turns = static_cast<float>(i) * 1.37e-5f;
        const double exact = static_cast<double>(turns) * 2 * std::numbers::pi;
        worst = std::max(worst, std::abs(static_cast<double>(sineOfTurns(turns)) - std::sin(exact)));
        worst = std::max(worst, std::abs(static_cast<double>(cosineOfTurns(turns)) - std::cos(exact)));
    }
    EXPECT_LT(worst, 5e-7);
}

TEST(Sine, IsPeriodicOverWholeTurns) {
    for (const float turns : {0.0f, 0.125f, 0.25f, 0.375f, 0.5f, 0.8125f})
        for (const float whole : {1.0f, -1.0f, 17.0f, 4096.0f, -65536.0f})
            EXPECT_EQ(sineOfTurns(turns), sineOfTurns(turns + whole));
}

TEST(Sine, HitsZerosExactlyAndExtremaClosely) {
    EXPECT_EQ(sineOfTurns(0.0f), 0.0f);
    EXPECT_EQ(sineOfTurns(0.5f), 0.0f);
    EXPECT_NEAR(sineOfTurns(0.25f), 1.0f, 1.2e-7f);
    EXPECT_NEAR(sineOfTurns(-0.25f), -1.0f, 1.2e-7f);
}

TEST(Bezier, EqualsTheBernsteinForm) {
    for (int i = 0; i <= 100; ++i) {
        const float t = static_cast<float>(i) / 100, s = 1 - t;
        const float bernstein = s * s * s * 0.3f + 3 * s * s * t * -1.2f + 3 * s * t * t * 2.5f + t * t * t * 0.7f;
        EXPECT_NEAR(bezier(0.3f, -1.2f, 2.5f, 0.7f, t), bernstein, 1e-6f);
        EXPECT_NEAR(bezierPolynomial(0.3f, -1.2f, 2.5f, 0.7f)(t), bernstein, 2e-6f);
    }
}

TEST(Bezier, OfAnyNumberOfPointsIsTheSumOfBernsteinPolynomials) {
    const std::vector<float> all{0.3f, -1.2f, 2.5f, 0.7f, 4.0f, -3.0f, 0.1f, 1.9f};
    for (std::size_t count = 1; count <= all.size(); ++count) {
        const std::span<const float> points = std::span(all).first(count);
        const std::vector<float> weights = bernsteinWeights(points);
        for (int k = 0; k <= 40; ++k) {
            const double t = k / 40.0;
            double sum = 0;
            for (std::size_t i = 0; i < count; ++i)
                sum += std::tgamma(static_cast<double>(count)) / std::tgamma(static_cast<double>(i + 1)) /
                       std::tgamma(static_cast<double>(count - i)) * std::pow(1 - t, count - 1 - i) * std::pow(t, i) *
                       static_cast<double>(points[i]);
            EXPECT_NEAR(bezier(points, static_cast<float>(t)), sum, 4e-6) << count << ' ' << t;
            EXPECT_NEAR(bernsteinSum(weights, static_cast<float>(t)), sum, 8e-6) << count << ' ' << t;
        }
        EXPECT_EQ(bezier(points, 0.0f), points.front());
        EXPECT_NEAR(bezier(points, 1.0f), points.back(), 5e-7);
    }
}

TEST(Bezier, StartsAndEndsAtItsOuterPoints) {
    const glm::vec3 a{1, 2, 3}, b{-4, 0, 9}, c{7, 7, 7}, d{0.5f, 0.25f, 8};
    EXPECT_EQ(bezier(a, b, c, d, 0.0f), a);
    EXPECT_EQ(bezier(a, b, c, d, 1.0f), d);
}

TEST(Bezier, IsTheStraightLineForEvenlySpacedPoints) {
    for (int i = 0; i <= 50; ++i) {
        const float t = static_cast<float>(i) / 50;
        EXPECT_NEAR(bezier(1.0f, 2.0f, 3.0f, 4.0f, t), 1 + 3 * t, 1e-6f);
    }
}

TEST(Bezier, StaysInTheHullOfItsPointsAndVectorsAreThreeScalars) {
    const glm::vec3 a{0.2f, 1, -3}, b{0.9f, 0, 9}, c{0.1f, 7, 7}, d{0.6f, 0.25f, 8};
    const auto polynomial = bezierPolynomial(a, b, c, d);
    for (int i = 0; i <= 50; ++i) {
        const float t = static_cast<float>(i) / 50;
        const glm::vec3 point = bezier(a, b, c, d, t);
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(point[k], bezier(a[k], b[k], c[k], d[k], t));
            EXPECT_GE(point[k], std::min({a[k], b[k], c[k], d[k]}));
            EXPECT_LE(point[k], std::max({a[k], b[k], c[k], d[k]}));
            EXPECT_NEAR(polynomial(t)[k], point[k], 1e-5f);
        }
    }
}

// Test vectors from the draft.
TEST(Hash, GivesTheKnownAnswersOfFnv1a) {
    EXPECT_EQ(Hash{}.value(), 0xcbf29ce484222325ULL);
    EXPECT_EQ(Hash{}.add("a").value(), 0xaf63dc4c8601ec8cULL);
    EXPECT_EQ(Hash{}.add("foobar").value(), 0x85944171f73967e8ULL);
}

TEST(Hash, PiecesEqualTheWhole) {
    EXPECT_EQ(Hash{}.add("foo").add("bar").value(), Hash{}.add("foobar").value());
}

TEST(Hash, SeesEveryBitOfAFloat) {
    EXPECT_NE(Hash{}.add(1.0f).value(), Hash{}.add(std::nextafter(1.0f, 2.0f)).value());
    EXPECT_NE(Hash{}.add(0.0f).value(), Hash{}.add(-0.0f).value());
}

TEST(FastFunctions, PowerOfTwoEqualsTheLibrarysToElevenDigits) {
    double worst = 0;
    for (double x = -1000; x <= 1000; x += 0.00731) worst = std::max(worst, std::abs(powerOfTwo(x) / std::exp2(x) - 1));
    EXPECT_LT(worst, 1e-11);
    EXPECT_GT(worst, 1e-13);  // otherwise the comment with 7e-12 is out of date
    for (const double n : {-1000.0, -3.0, 0.0, 1.0, 64.0}) EXPECT_EQ(powerOfTwo(n), std::exp2(n));
}

TEST(FastFunctions, HalfErrorFunctionEqualsTheLibrarysToTenDigits) {
    const HalfErrorFunction& halfErf = HalfErrorFunction::instance();
    double worst = 0, worstBeyond = 0;
    for (double z = -12; z <= 12; z += 0.000173) {
        const double error = std::abs(halfErf(z) - std::erf(z) / 2);
        double& of = std::abs(z) <= HalfErrorFunction::limit ? worst : worstBeyond;
        of = std::max(of, error);
        ASSERT_EQ(halfErf(-z), -halfErf(z));
    }
    EXPECT_LT(worst, 5e-11);
    EXPECT_LT(worstBeyond, 1.1e-9);
    EXPECT_EQ(halfErf(0), 0);
    EXPECT_EQ(halfErf(HUGE_VAL), halfErf(HalfErrorFunction::limit));
}

}  // namespace
}  // namespace dustbench::maths
