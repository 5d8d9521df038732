#include "bench/scene/driver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dustbench::bench {
namespace {

using scene::Terrain;
using scene::VehicleParameters;
using scene::VehicleState;

constexpr double driverTick = 1.0 / 60;

TEST(Driver, KeepsAConstantSpeed) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 20);
    for (int n = 0; n < 3600; ++n) {
        state = step(p, state, driver.decide(p, state, 20, 20, 0, driverTick), {}, driverTick);
        ASSERT_NEAR(state.speed, 20, 1e-6);
    }
}

TEST(Driver, FollowsARampThatTheVehicleCanDrive) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    const auto target = [](double t) { return t < 10 ? 2 * t : t < 20 ? 20 : std::max(0.0, 20 - 3 * (t - 20)); };
    for (int n = 0; n < 1800; ++n) {
        state =
            step(p, state, driver.decide(p, state, target(n * driverTick), target((n + 1) * driverTick), 0, driverTick),
                 {}, driverTick);
        ASSERT_NEAR(state.speed, target((n + 1) * driverTick), 0.05) << n;
    }
    EXPECT_EQ(state.speed, 0);
}

TEST(Driver, HoldsTheSpeedUpAHill) {
    const VehicleParameters p;
    const Terrain slope({0, 100, 0, 100}, 2, 2, 1000, 0, -500);
    Driver driver;
    VehicleState state = placeVehicle(p, slope, 10, 0, 0, 15);
    for (int n = 0; n < 1200; ++n)
        state = step(p, state, driver.decide(p, state, 15, 15, 0, driverTick), slope, driverTick);
    EXPECT_NEAR(state.speed, 15, 0.01);
}

TEST(Driver, DoesNotWindUpWhileTheTargetIsOutOfReach) {
    const VehicleParameters p;
    Driver driver;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    for (int n = 0; n < 240; ++n)
        state = step(p, state, driver.decide(p, state, 50, 50, 0, driverTick), {}, driverTick);
    double highest = 0;
    for (int n = 0; n < 1800; ++n) {
        state = step(p, state, driver.decide(p, state, 20, 20, 0, driverTick), {}, driverTick);
        highest = std::max(highest, state.speed);
    }
    EXPECT_LT(highest, 20.5);
    EXPECT_NEAR(state.speed, 20, 1e-3);
}

TEST(Driver, UsesOnePedalAtATimeWithinItsStops) {
    const VehicleParameters p;
    Driver driver;
    for (const double speed : {0.0, 3.0, 20.0, 50.0})
        for (const double target : {0.0, 5.0, 20.0, 60.0}) {
            const VehicleState state = placeVehicle(p, {}, 0, 0, 0, speed);
            const Controls controls = driver.decide(p, state, target, target, 0.25, driverTick);
            EXPECT_TRUE(controls.throttle == 0 || controls.brake == 0);
            EXPECT_GE(std::min(controls.throttle, controls.brake), 0);
            EXPECT_LE(std::max(controls.throttle, controls.brake), 1);
            EXPECT_EQ(controls.steer, 0.25);
        }
}

}  // namespace
}  // namespace dustbench::bench
