#include "bench/view/free_camera.h"

#include <algorithm>
#include <cmath>

namespace dustbench::view {
namespace {

constexpr double steepest = 1.5;  ///< radians above or below the horizon
constexpr double nearest = 0.2;   ///< metres

}  // namespace

world::CameraKey keyOf(const scene::Camera& camera, double seconds) {
    return {std::max(seconds, 0.0), camera.eye, camera.target, glm::degrees(camera.verticalFieldOfView)};
}

world::CameraKey turned(const world::CameraKey& key, double turn, double rise) {
    const glm::dvec3 arm = key.eye - key.target;
    const double length = glm::length(arm);
    const double azimuth = std::atan2(-arm.z, arm.x) + turn;
    const double elevation = std::clamp(std::asin(arm.y / length) + rise, -steepest, steepest);
    world::CameraKey result = key;
    result.eye = key.target + length * glm::dvec3(std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
                                                  -std::cos(elevation) * std::sin(azimuth));
    return result;
}

world::CameraKey dollied(const world::CameraKey& key, double factor) {
    const glm::dvec3 arm = key.eye - key.target;
    world::CameraKey result = key;
    result.eye = key.target + std::max(factor, nearest / glm::length(arm)) * arm;
    return result;
}

world::CameraKey shifted(const world::CameraKey& key, double right, double up) {
    const glm::dvec3 along = glm::normalize(key.target - key.eye);
    const glm::dvec3 toRight = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
    const glm::dvec3 move = right * toRight + up * glm::cross(toRight, along);
    world::CameraKey result = key;
    result.eye += move;
    result.target += move;
    return result;
}

}  // namespace dustbench::view
