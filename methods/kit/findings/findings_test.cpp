#include "methods/kit/findings/findings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace dustbench::findings {
namespace {

TEST(Findings, MeanHasStudentsInterval) {
    const Finding found = meanOf("m", {1, 2, 3, 4, 5});
    EXPECT_EQ(found.quantity, "m");
    EXPECT_DOUBLE_EQ(found.value, 3);
    const double half = 2.776445 * std::sqrt(2.5 / 5);  // t(0.975; 4), from tables
    EXPECT_NEAR(found.low, 3 - half, 1e-6);
    EXPECT_NEAR(found.high, 3 + half, 1e-6);
    EXPECT_EQ(found.samples, 5);
    const Finding equal = meanOf("e", {7, 7});
    EXPECT_EQ(equal.low, 7);
    EXPECT_EQ(equal.high, 7);
}

TEST(Findings, ExponentIsThatOfAPowerAndItsIntervalHoldsIt) {
    const Finding exact = exponentOf("e", {1, 2, 4, 8}, {3, 12, 48, 192});
    EXPECT_NEAR(exact.value, 2, 1e-12);
    const Finding noisy = exponentOf("n", {1, 2, 4, 8}, {3.1, 11.8, 49, 189});
    EXPECT_LT(noisy.low, 2);
    EXPECT_GT(noisy.high, 2);
}

TEST(Findings, MedianHasTheIntervalOfTheSignTest) {
    EXPECT_EQ(medianOf("m", {3, 1, 2}).value, 2);
    EXPECT_EQ(medianOf("m", {3, 1, 2}).high, 3);
    // From tables of the sign test: how many of n values lie below the interval.
    for (const auto& [n, below] : {std::pair{1, 0}, {8, 0}, {9, 1}, {12, 2}, {15, 3}, {25, 7}}) {
        std::vector<double> values(static_cast<std::size_t>(n));
        std::iota(values.rbegin(), values.rend(), 0);
        EXPECT_EQ(medianOf("m", values).low, below) << n;
        EXPECT_EQ(medianOf("m", values).high, n - 1 - below) << n;
    }
}

}  // namespace
}  // namespace dustbench::findings
