#include "bench/world/vehicle_dynamics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dustbench::world {
namespace {

using scene::Terrain;
using scene::VehicleParameters;
using scene::VehicleState;
using scene::Wheel;

/// A wheel's position in the vehicle's frame: `ahead` of the rear axle and to the `right`.
struct WheelPlace {
    double ahead, right;
};

WheelPlace wheelPlace(const VehicleParameters& p, std::size_t wheel) {
    const bool front = wheel == scene::frontLeft || wheel == scene::frontRight;
    const bool right = wheel == scene::frontRight || wheel == scene::rearRight;
    return {front ? p.wheelbaseMetres : 0, (right ? 0.5 : -0.5) * p.trackMetres};
}

/// Velocity of a wheel's hub relative to the vehicle's speed, forward and right, at path curvature κ: v + ω × r with ω
/// = κ v ⇒ (1 + κ·right, −κ·ahead).
struct Motion {
    double forward, right;
};

Motion wheelMotion(const VehicleParameters& p, double curvature, std::size_t wheel) {
    const WheelPlace place = wheelPlace(p, wheel);
    return {1 + curvature * place.right, -curvature * place.ahead};
}

double curvatureOf(const VehicleParameters& p, double steerAngle) {
    return std::tan(steerAngle) / p.wheelbaseMetres;
}

double groundHeight(const Terrain& terrain, double x, double z) {
    return static_cast<double>(terrain.heightAt(static_cast<float>(x), static_cast<float>(z)));
}

/// Places body and wheels on the ground, at the state's x, z, heading, speed and steering. Spin angles are kept.
void settle(const VehicleParameters& p, const Terrain& terrain, VehicleState& state) {
    const glm::dvec3 ahead(std::cos(state.heading), 0, -std::sin(state.heading));
    const glm::dvec3 right(-ahead.z, 0, ahead.x);
    std::array<double, 4> ground{};
    for (std::size_t i = 0; i < 4; ++i) {
        const WheelPlace place = wheelPlace(p, i);
        const glm::dvec3 below = state.position + place.ahead * ahead + place.right * right;
        ground[i] = groundHeight(terrain, below.x, below.z);
    }
    using enum Wheel;
    // Least-squares plane through the four corners of a rectangle.
    const double climb =
        (ground[frontLeft] + ground[frontRight] - ground[rearLeft] - ground[rearRight]) / (2 * p.wheelbaseMetres);
    const double bank =
        (ground[frontRight] + ground[rearRight] - ground[frontLeft] - ground[rearLeft]) / (2 * p.trackMetres);
    state.up = glm::normalize(glm::cross(right + glm::dvec3(0, bank, 0), ahead + glm::dvec3(0, climb, 0)));
    state.position.y = (ground[rearLeft] + ground[rearRight]) / 2;

    const glm::dvec3 bodyAhead = state.forward();
    const glm::dvec3 bodyRight = glm::cross(bodyAhead, state.up);
    const double curvature = curvatureOf(p, state.steerAngle);
    for (std::size_t i = 0; i < 4; ++i) {
        const WheelPlace place = wheelPlace(p, i);
        const Motion motion = wheelMotion(p, curvature, i);
        const double share = std::hypot(motion.forward, motion.right);
        scene::WheelState& wheel = state.wheels[i];
        wheel.contact = state.position + place.ahead * bodyAhead + place.right * bodyRight;
        wheel.contact.y = groundHeight(terrain, wheel.contact.x, wheel.contact.z);
        wheel.hub = wheel.contact + p.wheelRadiusMetres * state.up;
        wheel.forward = (motion.forward * bodyAhead + motion.right * bodyRight) / share;
        wheel.velocity = state.speed * share * wheel.forward;
        wheel.steerAngle = std::atan2(-motion.right, motion.forward);
        wheel.spinRate = state.speed * share / p.wheelRadiusMetres;
    }
}

/// sin(a)/a, smooth at 0.
double sinc(double a) {
    return std::abs(a) < 1e-4 ? 1 - a * a / 6 : std::sin(a) / a;
}

}  // namespace

double fullThrottleAcceleration(const VehicleParameters& p, double speed) {
    // min(a_max, P / (m v)), without the division at rest
    const double tractionPower = p.driveAccelerationLimit * p.massKilograms * speed;
    return tractionPower <= p.drivePowerWatts ? p.driveAccelerationLimit
                                              : p.drivePowerWatts / (p.massKilograms * speed);
}

double resistanceDeceleration(const VehicleParameters& p, double speed) {
    // ½ ρ c_d A v² / m + c_r g
    return 0.5 * airDensity * p.dragAreaSquareMetres * speed * speed / p.massKilograms + p.rollingResistance * gravity;
}

double steerAngleLimit(const VehicleParameters& p, double speed) {
    // v² tan δ / L ≤ a_lateral
    return std::min(p.steerLimit, std::atan2(p.lateralAccelerationLimit * p.wheelbaseMetres, speed * speed));
}

double wheelSteerAngle(const VehicleParameters& p, double bicycleAngle, Wheel wheel) {
    const Motion motion = wheelMotion(p, curvatureOf(p, bicycleAngle), wheel);
    return std::atan2(-motion.right, motion.forward);
}

VehicleState placeVehicle(const VehicleParameters& p, const Terrain& terrain, double x, double z, double heading,
                          double speed) {
    VehicleState state;
    state.position = {x, 0, z};
    state.heading = heading;
    state.speed = speed;
    settle(p, terrain, state);
    return state;
}

VehicleState step(const VehicleParameters& p, const VehicleState& state, const Controls& controls,
                  const Terrain& terrain, double dt) {
    VehicleState next = state;
    const glm::dvec3 ahead = state.forward();

    // dv/dt = throttle·a(v) − brake·b − resistance(v) − g·slope, by the midpoint rule.
    const double hold = controls.brake * p.brakeDecelerationLimit + gravity * ahead.y;
    const auto acceleration = [&](double speed) {
        return controls.throttle * fullThrottleAcceleration(p, speed) - resistanceDeceleration(p, speed) - hold;
    };
    const double middle = std::max(0.0, state.speed + acceleration(state.speed) * dt / 2);
    double gain = acceleration(middle);
    if (state.speed + gain * dt > p.topSpeed) gain = std::min(gain, std::max(0.0, p.topSpeed - state.speed) / dt);
    double distance;
    if (state.speed + gain * dt >= 0) {
        next.speed = state.speed + gain * dt;
        distance = (state.speed + next.speed) / 2 * dt;
    } else {  // stops within the step and stays at rest
        next.speed = 0;
        distance = state.speed * state.speed / (-2 * gain);
        gain = -state.speed / dt;
    }
    next.acceleration = gain;

    const double reach = p.steerRateLimit * dt;
    const double wanted = std::clamp(controls.steer, -1.0, 1.0) * p.steerLimit;
    const double limit = steerAngleLimit(p, next.speed);
    next.steerAngle = std::clamp(std::clamp(wanted, state.steerAngle - reach, state.steerAngle + reach), -limit, limit);

    // An arc of the mean curvature: exact for constant steering. Δψ = κ s, chord = s·sinc(Δψ/2) at ψ + Δψ/2.
    const double curvature = (curvatureOf(p, state.steerAngle) + curvatureOf(p, next.steerAngle)) / 2;
    const double turn = curvature * distance;
    const double chord = distance * std::hypot(ahead.x, ahead.z) * sinc(turn / 2);
    next.position.x += chord * std::cos(state.heading + turn / 2);
    next.position.z -= chord * std::sin(state.heading + turn / 2);
    next.heading += turn;
    for (std::size_t i = 0; i < 4; ++i) {
        const Motion motion = wheelMotion(p, curvature, i);
        next.wheels[i].spinAngle += distance * std::hypot(motion.forward, motion.right) / p.wheelRadiusMetres;
    }
    settle(p, terrain, next);
    return next;
}

}  // namespace dustbench::world
