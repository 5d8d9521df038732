// The births experiment in worlds that the harness provides.
#include <gtest/gtest.h>

#include "bench/claims/lent_context.h"
#include "methods/voxel_shape/births_experiment.h"

namespace dustbench::voxel_shape::births {
namespace {

TEST(BirthExperiment, FindsNoneInSolidsThatTheMethodKnowsAndManyInThoseItDoesNot) {
    bench::LentContext context(1);
    const BirthReport told = driveThroughWalls(context, true, 3.5), untold = driveThroughWalls(context, false, 3.5);
    EXPECT_EQ(told.inSolids, 0);
    EXPECT_GT(told.births, 100'000);
    EXPECT_GT(untold.inSolids, 100) << "198 to 212 with seeds 1, 2 and 3";
}

}  // namespace
}  // namespace dustbench::voxel_shape::births
