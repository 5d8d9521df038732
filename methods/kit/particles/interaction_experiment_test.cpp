#include "methods/kit/particles/interaction_experiment.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

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
        // With a force that falls faster, the error comes from nearer bodies: combined and ignored ones matter less.
        EXPECT_LT(found.at("rms_cube_ignored_0.6").high, found.at("rms_ignored_0.6").low);
        EXPECT_LT(found.at("rms_cube_ignored_0.1").high, found.at("rms_cube_ignored_0.6").low);
        for (const char* name : {"rms_cube_ignored_0.1", "rms_cube_ignored_0.3", "rms_cube_ignored_0.6"})
            RecordProperty(std::string(name) + "_seed_" + std::to_string(seed), std::to_string(found.at(name).value));
        EXPECT_LT(found.at("rms_cube_angle_0.6").high, found.at("rms_cube_ignored_0.6").low);
        EXPECT_EQ(found.at("together_over_together_0.6").value, 1);
        EXPECT_EQ(found.at("ignored_over_together_0.6").value,
                  found.at("rms_ignored_0.6").value / found.at("rms_angle_0.6").value);
        EXPECT_GT(found.at("tree_work_exponent").low, 0.9);
        EXPECT_LT(found.at("tree_work_exponent").high, 1.4);
    }
}

}  // namespace
}  // namespace dustbench::particles::interaction
