#include "bench/scene/driver.h"

#include <algorithm>

namespace dustbench::bench {
namespace {

constexpr double proportionalPerSecond = 1.5;
constexpr double integralPerSquareSecond = 0.3;
/// Below this speed, with a target of 0, the driver brakes to a halt and holds the car.
constexpr double haltSpeed = 0.3;
constexpr double haltBrake = 0.3;

}  // namespace

Controls Driver::decide(const scene::VehicleParameters& parameters, const scene::VehicleState& state, double targetNow,
                        double targetNext, double steer, double dt) {
    if (targetNow <= 0 && targetNext <= 0 && state.speed < haltSpeed) {
        integral_ = 0;
        return {0, haltBrake, steer};
    }
    const double error = targetNow - state.speed;
    // a = dv*/dt + resistance + g·slope + k_p e + ∫ k_i e dt
    const double wanted = (targetNext - targetNow) / dt + resistanceDeceleration(parameters, state.speed) +
                          gravity * state.forward().y + proportionalPerSecond * error + integral_;
    const double maximum = fullThrottleAcceleration(parameters, state.speed);
    const double minimum = -parameters.brakeDecelerationLimit;
    const bool atStop = (wanted >= maximum && error > 0) || (wanted <= minimum && error < 0);
    if (!atStop) integral_ += integralPerSquareSecond * error * dt;
    return {std::clamp(wanted / maximum, 0.0, 1.0), std::clamp(wanted / minimum, 0.0, 1.0), steer};
}

}  // namespace dustbench::bench
