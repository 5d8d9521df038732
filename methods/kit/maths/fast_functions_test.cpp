#include "methods/kit/maths/fast_functions.h"

#include <gtest/gtest.h>

namespace dustbench::maths {
namespace {

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
