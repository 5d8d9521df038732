#include "methods/kit/particles/interaction_experiment.h"

#include <gtest/gtest.h>

#include <map>

#include "methods/kit/particles/timing.h"

namespace dustbench::particles::interaction {
namespace {

TEST(InteractionExperiment, ErrorGrowsWithTheAngleAndWorkLessThanItsSquare) {
    for (const std::uint64_t seed : {1u, 2u}) {
        std::map<std::string, Finding> found;
        for (Finding& finding : measureErrors(seed)) found[finding.quantity] = finding;
        EXPECT_LT(found.at("rms_angle_0.6").high, 0.01);
        EXPECT_LT(found.at("rms_angle_0.3").high, found.at("rms_angle_0.6").low);
        EXPECT_LT(found.at("rms_angle_0.6").high, found.at("rms_angle_1.2").low);
        // A cell's dipole vanishes about its centre of mass; the quadrupole term decreases as the square of the angle,
        // and errors of many cells add up as their root.
        EXPECT_GT(found.at("error_exponent").value, 1.5);
        EXPECT_LT(found.at("error_exponent").value, 3.5);
        EXPECT_GT(found.at("rms_ignored_0.6").low, 0.3);
        EXPECT_GT(found.at("tree_work_exponent").low, 0.9);
        EXPECT_LT(found.at("tree_work_exponent").high, 1.4);
    }
}

TEST(Timing, ExponentIsThatOfAPowerAndItsIntervalHoldsIt) {
    const Finding exact = exponentOf("e", {1, 2, 4, 8}, {3, 12, 48, 192});
    EXPECT_NEAR(exact.value, 2, 1e-12);
    const Finding noisy = exponentOf("n", {1, 2, 4, 8}, {3.1, 11.8, 49, 189});
    EXPECT_LT(noisy.low, 2);
    EXPECT_GT(noisy.high, 2);
    EXPECT_EQ(medianOf("m", {3, 1, 2}).value, 2);
    EXPECT_EQ(medianOf("m", {3, 1, 2}).high, 3);
    // By tables of the sign test.
    for (const auto& [count, below] :
         std::map<std::size_t, std::size_t>{{1, 0}, {8, 0}, {9, 1}, {12, 2}, {15, 3}, {25, 7}})
        EXPECT_EQ(valuesBelowTheInterval(count), below) << count;
    const Finding nine = medianOf("m", {9, 1, 8, 2, 7, 3, 6, 4, 5});
    EXPECT_EQ(nine.value, 5);
    EXPECT_EQ(nine.low, 2);
    EXPECT_EQ(nine.high, 8);
}

}  // namespace
}  // namespace dustbench::particles::interaction
