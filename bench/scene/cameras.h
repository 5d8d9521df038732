// The cameras of a scene: one that stands, one that chases the vehicle, one that circles it. Pure functions of state
// and time.
//
// Units: SI, radians. Frame: world, or the vehicle's heading frame (+X forward, +Y up, +Z right) where said.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"

namespace dustbench::bench {

enum class CameraKind { chase, fixed, orbit };
inline constexpr Choices<CameraKind> cameraKinds{
    {"chase", CameraKind::chase}, {"fixed", CameraKind::fixed}, {"orbit", CameraKind::orbit}};

struct FixedCamera {
    glm::dvec3 eye{30, 4, 24};
    glm::dvec3 target{0, 1, 0};
    double verticalFieldOfView = 0.9;
};

/// Moves with the vehicle's smoothed heading and height; looks behind it, where the dust is.
struct ChaseCamera {
    glm::dvec3 offset{6.8, 2.5, 9.4};
    glm::dvec3 lookAt{-4.2, 1.2, 0};
    double smoothingSeconds = 0.5;
    double verticalFieldOfView = 0.9;
};

struct OrbitCamera {
    double radiusMetres = 18;
    double heightMetres = 5;
    double turnRate = 0.25;   ///< rad/s, counter-clockwise seen from above
    double startAngle = 0.7;  ///< at time 0, from the world's +X
    glm::dvec3 lookAt{-3, 0.8, 0};
    double verticalFieldOfView = 0.9;
};

struct CameraSet {
    FixedCamera fixed;
    ChaseCamera chase;
    OrbitCamera orbit;
};

/// The vehicle's heading and height as a chasing camera sees them: a first-order lag behind the true ones.
struct CameraLag {
    double heading = 0;
    double height = 0;

    /// At rest with the vehicle.
    [[nodiscard]] static CameraLag at(const scene::VehicleState& vehicle);
    /// `dt` seconds later, while the vehicle is as given.
    [[nodiscard]] CameraLag followed(const scene::VehicleState& vehicle, double lagSeconds, double dt) const;
};

[[nodiscard]] scene::Camera cameraAt(CameraKind kind, const CameraSet& cameras, const scene::SceneState& state,
                                     const CameraLag& lag, const scene::Terrain& terrain);

}  // namespace dustbench::bench
