// Vehicle motion: a kinematic bicycle that drives, brakes, steers and follows the ground. Pure functions.
//
// Units: SI, radians. Frame: world; positive steering turns left (the heading increases).
// Source: Rajamani2012, 2.2 (kinematic bicycle model) and 4.1 (longitudinal forces).
// Departs: no slip; the wheels follow the ground without springs; resistance never drives the vehicle backwards.
#pragma once

#include "methods/contract/terrain.h"
#include "methods/contract/vehicle.h"

namespace dustbench::world {

inline constexpr double gravity = 9.80665;   ///< m/s²
inline constexpr double airDensity = 1.204;  ///< kg/m³ at 20 °C and 1013 hPa

/// The driver's input. Throttle and brake 0..1, steering −1..1 of the limit (positive: left).
struct Controls {
    double throttle = 0;
    double brake = 0;
    double steer = 0;
};

/// Acceleration at full throttle, limited by tyre grip or engine power.
[[nodiscard]] double fullThrottleAcceleration(const scene::VehicleParameters& parameters, double speed);

/// Deceleration due to air drag and rolling resistance on level ground.
[[nodiscard]] double resistanceDeceleration(const scene::VehicleParameters& parameters, double speed);

/// Maximum steering angle of the bicycle at a speed: the limit of the linkage or of the lateral acceleration.
[[nodiscard]] double steerAngleLimit(const scene::VehicleParameters& parameters, double speed);

/// Steering angle of one wheel, such that all four turn about one centre (Ackermann).
[[nodiscard]] double wheelSteerAngle(const scene::VehicleParameters& parameters, double bicycleAngle,
                                     scene::Wheel wheel);

/// The vehicle on the ground at (x, z), rolling at `speed`.
[[nodiscard]] scene::VehicleState placeVehicle(const scene::VehicleParameters& parameters,
                                               const scene::Terrain& terrain, double x, double z, double heading,
                                               double speed);

/// One step of `dt` seconds with constant controls.
[[nodiscard]] scene::VehicleState step(const scene::VehicleParameters& parameters, const scene::VehicleState& state,
                                       const Controls& controls, const scene::Terrain& terrain, double dt);

}  // namespace dustbench::world
