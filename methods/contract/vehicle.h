// The vehicle: its parameters, and the state of the body and its wheels.
//
// Units: SI, radians. Frame: world, +Y up; heading 0 looks along +X and grows counter-clockwise seen from above
// (towards −Z). Vehicle frame: +X forward, +Y up, +Z right, origin on the ground under the rear axle.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace dustbench::scene {

struct VehicleParameters {
    double wheelbaseMetres = 2.6;
    double trackMetres = 1.55;
    double wheelRadiusMetres = 0.33;
    double wheelWidthMetres = 0.22;
    double massKilograms = 1250;
    double steerLimit = 0.6;              ///< radians at the front wheels (bicycle model)
    double steerRateLimit = 1.2;          ///< radians per second
    double lateralAccelerationLimit = 7;  ///< m/s²: limits the steering angle
    double driveAccelerationLimit = 4.5;  ///< m/s² at full throttle, from rest
    double drivePowerWatts = 180e3;       ///< at full throttle, once the acceleration limit exceeds P/(m·v)
    double brakeDecelerationLimit = 8;    ///< m/s² at full brake
    double dragAreaSquareMetres = 0.7;    ///< c_d · A
    double rollingResistance = 0.012;     ///< fraction of the weight
    double topSpeed = 60;                 ///< m/s
};

struct WheelState {
    glm::dvec3 hub{0};            ///< centre of the wheel
    glm::dvec3 contact{0};        ///< contact point on the ground
    glm::dvec3 velocity{0};       ///< of the hub, m/s
    double steerAngle = 0;        ///< relative to the body
    double spinAngle = 0;         ///< rolled angle, radians, positive forwards
    double spinRate = 0;          ///< rad/s
    glm::dvec3 forward{1, 0, 0};  ///< rolling direction, unit, in the ground plane
};

enum Wheel { frontLeft, frontRight, rearLeft, rearRight };

struct DUSTBENCH_API VehicleState {
    glm::dvec3 position{0};  ///< the vehicle's origin: on the ground under the rear axle
    double heading = 0;
    double speed = 0;         ///< m/s along the heading, never negative
    double acceleration = 0;  ///< m/s² along the heading
    double steerAngle = 0;    ///< of the bicycle's front wheel
    glm::dvec3 up{0, 1, 0};   ///< of the body, follows the ground
    std::array<WheelState, 4> wheels{};

    /// Unit vector along the heading, tangent to the ground.
    [[nodiscard]] glm::dvec3 forward() const;
    /// From the vehicle frame to the world.
    [[nodiscard]] glm::dmat4 toWorld() const;
};

}  // namespace dustbench::scene
