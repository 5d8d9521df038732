#include "bench/world/vehicle_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dustbench::world {
namespace {

using scene::Terrain;
using scene::VehicleParameters;
using scene::VehicleState;

constexpr double dynamicsTick = 1.0 / 60;

VehicleParameters withoutResistance() {
    VehicleParameters parameters;
    parameters.dragAreaSquareMetres = 0;
    parameters.rollingResistance = 0;
    return parameters;
}

Terrain hills() {
    std::vector<float> heights(65 * 65);
    for (int j = 0; j < 65; ++j)
        for (int i = 0; i < 65; ++i)
            heights[static_cast<std::size_t>(j * 65 + i)] =
                2 * std::sin(0.2f * static_cast<float>(i)) * std::cos(0.15f * static_cast<float>(j));
    return {heights, 65, 65, 4.0f, -128, -128};
}

TEST(VehicleDynamics, DrivesACircleOfRadiusWheelbaseOverTanSteer) {
    const VehicleParameters p = withoutResistance();
    const double delta = 0.2, radius = p.wheelbaseMetres / std::tan(delta);
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 5);
    state.steerAngle = delta;
    const glm::dvec3 centre(0, 0, -radius);  // to the left
    for (int n = 0; n < 2000; ++n) {
        state = step(p, state, {0, 0, delta / p.steerLimit}, {}, dynamicsTick);
        ASSERT_NEAR(glm::distance(state.position, centre), radius, 1e-9);
        ASSERT_NEAR(state.heading, 5 * dynamicsTick * (n + 1) / radius, 1e-9);
    }
}

TEST(VehicleDynamics, StopsAfterSpeedSquaredOverTwiceTheDeceleration) {
    const VehicleParameters p = withoutResistance();
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 31.7);
    for (int n = 0; n < 600; ++n) state = step(p, state, {0, 0.75, 0}, {}, dynamicsTick);
    EXPECT_EQ(state.speed, 0);
    EXPECT_NEAR(state.position.x, 31.7 * 31.7 / (2 * 0.75 * p.brakeDecelerationLimit), 1e-9);
}

TEST(VehicleDynamics, ReachesTheSpeedWherePowerEqualsResistance) {
    VehicleParameters p;
    p.topSpeed = 200;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    for (int n = 0; n < 60 * 300; ++n) state = step(p, state, {1, 0, 0}, {}, dynamicsTick);
    EXPECT_NEAR(state.speed * resistanceDeceleration(p, state.speed) * p.massKilograms, p.drivePowerWatts, 1);
}

TEST(VehicleDynamics, NeverExceedsTheTopSpeed) {
    VehicleParameters p;
    p.topSpeed = 17.3;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    for (int n = 0; n < 1200; ++n) {
        state = step(p, state, {1, 0, 0}, {}, dynamicsTick);
        ASSERT_LE(state.speed, p.topSpeed + 1e-12);
    }
    EXPECT_NEAR(state.speed, p.topSpeed, 1e-9);
}

TEST(VehicleDynamics, ChangesItsEnergyByTheWorkOfItsForces) {
    const VehicleParameters p;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    double work = 0;
    for (int n = 0; n < 1800; ++n) {
        const double before = state.position.x;
        state = step(p, state, n % 300 < 240 ? Controls{0.7, 0, 0} : Controls{0, 0.2, 0}, {}, dynamicsTick);
        work += state.acceleration * (state.position.x - before);
        ASSERT_NEAR(work, state.speed * state.speed / 2, 1e-9 * (1 + work)) << n;
    }
}

TEST(VehicleDynamics, TradesHeightForSpeedWhenItCoasts) {
    const VehicleParameters p = withoutResistance();
    // A plane that falls by one in ten along +X.
    const Terrain slope({0, -100, 0, -100}, 2, 2, 1000, 0, -500);
    VehicleState state = placeVehicle(p, slope, 10, 0, 0, 1);
    const double start = state.position.y;
    for (int n = 0; n < 600; ++n) state = step(p, state, {}, slope, dynamicsTick);
    EXPECT_NEAR(state.speed * state.speed / 2 - 0.5, gravity * (start - state.position.y), 1e-3 * gravity);
    EXPECT_NEAR(state.forward().y, -0.1 / std::hypot(1, 0.1), 1e-6);
}

TEST(VehicleDynamics, ConvergesAtSecondOrderInTheStep) {
    const VehicleParameters p;
    const auto drive = [&](int steps) {
        VehicleState state = placeVehicle(p, {}, 0, 0, 0.3, 35);
        const double dt = 4.0 / steps;
        for (int n = 0; n < steps; ++n) {
            // Steering at the end of each step, changing more slowly than its rate limit.
            state = step(p, state, {0.8, 0, 0.02 * std::sin((n + 1) * dt)}, {}, dt);
        }
        return state;
    };
    const VehicleState fine = drive(16384);
    const double coarse = glm::distance(drive(64).position, fine.position);
    const double finer = glm::distance(drive(128).position, fine.position);
    EXPECT_GT(coarse, 1e-6);
    EXPECT_NEAR(std::log2(coarse / finer), 2, 0.2);
}

TEST(VehicleDynamics, FrontWheelsPointAtRightAnglesToTheCommonCentre) {
    const VehicleParameters p;
    for (const double delta : {-0.6, -0.2, 0.05, 0.4, 0.6}) {
        const double radius = p.wheelbaseMetres / std::tan(delta);
        const double left = wheelSteerAngle(p, delta, scene::frontLeft);
        const double right = wheelSteerAngle(p, delta, scene::frontRight);
        // Ackermann: cot δ_right − cot δ_left = track / wheelbase.
        EXPECT_NEAR(1 / std::tan(right) - 1 / std::tan(left), p.trackMetres / p.wheelbaseMetres, 1e-12);
        EXPECT_NEAR(std::tan(left), p.wheelbaseMetres / (radius - p.trackMetres / 2), 1e-12);
        EXPECT_EQ(wheelSteerAngle(p, delta, scene::rearLeft), 0);
        EXPECT_EQ(wheelSteerAngle(p, delta, scene::rearRight), 0);
    }
}

TEST(VehicleDynamics, HubsMoveAlongTheirWheelsAndSpinWithoutSlip) {
    const VehicleParameters p;
    VehicleState state = placeVehicle(p, {}, 3, 4, 0.5, 9);
    for (int n = 0; n < 200; ++n) state = step(p, state, {0.3, 0, 0.5}, {}, dynamicsTick);
    const VehicleState next = step(p, state, {0.3, 0, 0.5}, {}, 1e-5);
    for (std::size_t i = 0; i < 4; ++i) {
        const scene::WheelState& wheel = state.wheels[i];
        const glm::dvec3 moved = (next.wheels[i].hub - wheel.hub) / 1e-5;
        EXPECT_NEAR(glm::distance(moved, wheel.velocity), 0, 2e-3);
        EXPECT_NEAR(glm::dot(wheel.velocity, wheel.forward), glm::length(wheel.velocity), 1e-12);
        EXPECT_NEAR(wheel.spinRate, glm::length(wheel.velocity) / p.wheelRadiusMetres, 1e-12);
        EXPECT_NEAR((next.wheels[i].spinAngle - wheel.spinAngle) / 1e-5, wheel.spinRate, 2e-3);
    }
    EXPECT_GT(state.wheels[scene::frontRight].spinRate, state.wheels[scene::frontLeft].spinRate);  // turns left
}

TEST(VehicleDynamics, NeverReversesWhateverThePedals) {
    const VehicleParameters p;
    const Terrain terrain = hills();
    std::mt19937 random(9);
    VehicleState state = placeVehicle(p, terrain, 0, 0, 0, 2);
    for (int n = 0; n < 20000; ++n) {
        const double throttle = static_cast<double>(random() % 100) / 300;
        const double brake = static_cast<double>(random() % 100) / 300;
        const double steer = static_cast<double>(random() % 201) / 100 - 1;
        const VehicleState next = step(p, state, {throttle, brake, steer}, terrain, dynamicsTick);
        ASSERT_GE(next.speed, 0);
        ASSERT_GE(glm::dot(next.position - state.position, state.forward()), -1e-9);
        for (std::size_t i = 0; i < 4; ++i) ASSERT_GE(next.wheels[i].spinAngle, state.wheels[i].spinAngle);
        state = next;
    }
}

TEST(VehicleDynamics, KeepsTheLimitsOfSteeringRateAndLateralAcceleration) {
    const VehicleParameters p;
    VehicleState state = placeVehicle(p, {}, 0, 0, 0, 2);
    for (int n = 0; n < 1200; ++n) {
        const VehicleState next = step(p, state, {1, 0, n % 200 < 100 ? 1.0 : -1.0}, {}, dynamicsTick);
        ASSERT_LE(std::abs(next.steerAngle - state.steerAngle), p.steerRateLimit * dynamicsTick + 1e-12);
        ASSERT_LE(next.speed * next.speed * std::abs(std::tan(next.steerAngle)) / p.wheelbaseMetres,
                  p.lateralAccelerationLimit + 1e-9);
        state = next;
    }
}

TEST(VehicleDynamics, StandsWithAllWheelsOnTheGround) {
    const VehicleParameters p;
    const Terrain terrain = hills();
    for (int n = 0; n < 100; ++n) {
        const VehicleState state = placeVehicle(p, terrain, 0.9 * n - 45, 30 - 0.7 * n, 0.1 * n, 5);
        for (std::size_t i = 0; i < 4; ++i) {
            const scene::WheelState& wheel = state.wheels[i];
            EXPECT_EQ(wheel.contact.y, static_cast<double>(terrain.heightAt(static_cast<float>(wheel.contact.x),
                                                                            static_cast<float>(wheel.contact.z))));
            EXPECT_NEAR(glm::distance(wheel.hub, wheel.contact), p.wheelRadiusMetres, 1e-12);
            // The body's plane lies between the ground heights under its wheels.
            EXPECT_LT(std::abs(glm::dot(wheel.contact - state.position, state.up)), 0.1);
        }
        EXPECT_NEAR(glm::length(state.up), 1, 1e-12);
    }
}

TEST(VehicleDynamics, PutsLeftWheelsToTheLeft) {
    const VehicleParameters p;
    const VehicleState state = placeVehicle(p, {}, 0, 0, 0, 0);
    EXPECT_NEAR(state.wheels[scene::frontLeft].contact.z, -p.trackMetres / 2, 1e-12);
    EXPECT_NEAR(state.wheels[scene::frontLeft].contact.x, p.wheelbaseMetres, 1e-12);
    EXPECT_NEAR(state.wheels[scene::rearRight].contact.z, p.trackMetres / 2, 1e-12);
    EXPECT_NEAR(state.wheels[scene::rearRight].contact.x, 0, 1e-12);
}

}  // namespace
}  // namespace dustbench::world
