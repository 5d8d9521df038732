#include "methods/kit/octree/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dustbench::octree {
namespace {

TEST(OctreeWorld, MovesInWholeStepsAndKeepsTheCentreInItsMiddle) {
    EXPECT_EQ(octreeWorldOrigin({0, 0, 0}, 128, 8), glm::dvec3(-64));
    EXPECT_EQ(octreeWorldOrigin({3.9, 0, -3.9}, 128, 8), glm::dvec3(-64));
    EXPECT_EQ(octreeWorldOrigin({4.1, 0, -4.1}, 128, 8), glm::dvec3(-56, -64, -72));
    for (int n = -500; n < 500; ++n) {
        const glm::dvec3 centre(0.37 * n, 0.01 * n, -1.13 * n);
        const glm::dvec3 origin = octreeWorldOrigin(centre, 128, 8);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(std::remainder(origin[i], 8), 0);
            EXPECT_LE(std::abs(origin[i] + 64 - centre[i]), 4);
        }
    }
}

TEST(OctreeWorld, RefusesAStepThatIsNoPartOfTheEdge) {
    EXPECT_THROW(static_cast<void>(octreeWorldOrigin({}, 128, 0)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(octreeWorldOrigin({}, 128, 129)), std::invalid_argument);
}

}  // namespace
}  // namespace dustbench::octree
