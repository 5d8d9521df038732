// The births experiment in worlds that the harness provides.
#include <gtest/gtest.h>

#include "bench/claims/experiments.h"
#include "methods/voxel_shape/births_experiment.h"

namespace dustbench::voxel_shape::births {
namespace {

TEST(BirthExperiment, FindsNoneInSolidsThatTheMethodKnowsAndManyInThoseItDoesNot) {
    claims::ProgramContext context(1);
    const BirthReport known = driveThroughWalls(context, true, 3.5), unknown = driveThroughWalls(context, false, 3.5);
    EXPECT_EQ(known.inSolids, 0);
    EXPECT_GT(known.births, 100'000);
    EXPECT_GT(unknown.inSolids, 100) << "198 to 212 with seeds 1, 2 and 3";
}

}  // namespace
}  // namespace dustbench::voxel_shape::births
