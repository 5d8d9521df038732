#include "bench/view/free_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dustbench::view {
namespace {

world::CameraKey randomKey(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-20, 20);
    const auto point = [&] { return glm::dvec3(place(random), place(random), place(random)); };
    return {1, point(), point(), 50};
}

TEST(FreeCamera, TurnsOnASphereAboutItsTarget) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const world::CameraKey key = randomKey(seed);
        const world::CameraKey once = turned(key, 0.3, 0.1);
        EXPECT_NEAR(glm::distance(once.eye, once.target), glm::distance(key.eye, key.target), 1e-9);
        EXPECT_EQ(once.target, key.target);
        EXPECT_LT(glm::distance(turned(once, -0.3, -0.1).eye, key.eye), 1e-9);
        world::CameraKey around = key;
        for (int n = 0; n < 8; ++n) around = turned(around, std::numbers::pi / 4, 0);
        EXPECT_LT(glm::distance(around.eye, key.eye), 1e-9);
    }
    const world::CameraKey east{0, {10, 0, 0}, {0, 0, 0}, 50};
    EXPECT_LT(turned(east, 0.1, 0).eye.z, 0);  // counter-clockwise seen from above
    EXPECT_GT(turned(east, 0, 0.1).eye.y, 0);
}

TEST(FreeCamera, NeverTurnsOverTheVertical) {
    world::CameraKey key = randomKey(3);
    for (int n = 0; n < 100; ++n) {
        key = turned(key, 0, 0.2);
        const glm::dvec3 arm = glm::normalize(key.eye - key.target);
        ASSERT_GT(std::hypot(arm.x, arm.z), 0.05);
    }
}

TEST(FreeCamera, DolliesAlongItsRayAndStopsBeforeTheTarget) {
    const world::CameraKey key = randomKey(4);
    EXPECT_LT(glm::distance(dollied(dollied(key, 2), 0.5).eye, key.eye), 1e-9);
    world::CameraKey close = key;
    for (int n = 0; n < 60; ++n) close = dollied(close, 0.5);
    EXPECT_NEAR(glm::distance(close.eye, close.target), 0.2, 1e-9);
}

TEST(FreeCamera, ShiftsEyeAndTargetAlike) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const world::CameraKey key = randomKey(seed), moved = shifted(key, 3, 4);
        const glm::dvec3 by = moved.eye - key.eye;
        EXPECT_LT(glm::distance(by, moved.target - key.target), 1e-9);
        EXPECT_NEAR(glm::length(by), 5, 1e-9);
        EXPECT_NEAR(glm::dot(by, key.target - key.eye), 0, 1e-8);
        EXPECT_GT(by.y, 0);
    }
}

}  // namespace
}  // namespace dustbench::view
