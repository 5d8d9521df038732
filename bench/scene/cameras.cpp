#include "bench/scene/cameras.h"

#include <algorithm>
#include <cmath>

namespace dustbench::bench {
namespace {

/// Minimum height of a camera above the ground.
constexpr double groundClearance = 0.5;

/// Transforms a point from the level frame with the given heading to the world.
glm::dvec3 turned(const glm::dvec3& point, double heading, const glm::dvec3& origin) {
    const glm::dvec3 ahead(std::cos(heading), 0, -std::sin(heading));
    const glm::dvec3 right(-ahead.z, 0, ahead.x);
    return origin + point.x * ahead + glm::dvec3(0, point.y, 0) + point.z * right;
}

glm::dvec3 aboveGround(glm::dvec3 eye, const scene::Terrain& terrain) {
    const double ground = static_cast<double>(terrain.heightAt(static_cast<float>(eye.x), static_cast<float>(eye.z)));
    eye.y = std::max(eye.y, ground + groundClearance);
    return eye;
}

}  // namespace

CameraLag CameraLag::at(const scene::VehicleState& vehicle) {
    return {vehicle.heading, vehicle.position.y};
}

CameraLag CameraLag::followed(const scene::VehicleState& vehicle, double lagSeconds, double dt) const {
    // The exact solution of dh/dt = (h* − h)/τ for constant h*.
    const double share = lagSeconds > 0 ? 1 - std::exp(-dt / lagSeconds) : 1;
    return {heading + share * (vehicle.heading - heading), height + share * (vehicle.position.y - height)};
}

scene::Camera cameraAt(CameraKind kind, const CameraSet& cameras, const scene::SceneState& state, const CameraLag& lag,
                       const scene::Terrain& terrain) {
    const glm::dvec3 origin(state.vehicle.position.x, lag.height, state.vehicle.position.z);
    scene::Camera camera;
    switch (kind) {
        case CameraKind::fixed:
            camera.eye = cameras.fixed.eye;
            camera.target = cameras.fixed.target;
            camera.verticalFieldOfView = cameras.fixed.verticalFieldOfView;
            break;
        case CameraKind::chase:
            camera.eye = aboveGround(turned(cameras.chase.offset, lag.heading, origin), terrain);
            camera.target = turned(cameras.chase.lookAt, lag.heading, origin);
            camera.verticalFieldOfView = cameras.chase.verticalFieldOfView;
            break;
        case CameraKind::orbit: {
            const OrbitCamera& orbit = cameras.orbit;
            const glm::dvec3 middle = turned(orbit.lookAt, lag.heading, origin);
            const double angle = orbit.startAngle + orbit.turnRate * state.timeSeconds;
            const glm::dvec3 arm(orbit.radiusMetres * std::cos(angle), orbit.heightMetres,
                                 -orbit.radiusMetres * std::sin(angle));
            camera.eye = aboveGround(glm::dvec3(middle.x, origin.y, middle.z) + arm, terrain);
            camera.target = middle;
            camera.verticalFieldOfView = orbit.verticalFieldOfView;
            break;
        }
        case CameraKind::wheel:
            camera.eye = turned(cameras.wheel.offset, state.vehicle.heading, state.vehicle.position);
            camera.target = turned(cameras.wheel.lookAt, state.vehicle.heading, state.vehicle.position);
            camera.verticalFieldOfView = cameras.wheel.verticalFieldOfView;
            break;
    }
    return camera;
}

}  // namespace dustbench::bench
