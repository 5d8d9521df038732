#include "bench/reference/camera_rays.h"

#include <cmath>
#include <stdexcept>

namespace dustbench::bench {

CameraRays::CameraRays(const scene::View& view)
    : width_(view.width),
      height_(view.height),
      eye_(view.camera.eye),
      limitX_(std::tan(view.camera.verticalFieldOfView / 2) * view.width / view.height),
      limitY_(std::tan(view.camera.verticalFieldOfView / 2)) {
    if (width_ < 1 || height_ < 1) throw std::invalid_argument("CameraRays: an image without pixels");
    const scene::Camera& camera = view.camera;
    const glm::dvec3 sight = camera.target - camera.eye;
    const double length = glm::length(sight);
    if (!std::isfinite(length) || !std::isfinite(glm::length(camera.up)) || !(limitY_ > 0) || !std::isfinite(limitX_))
        throw std::invalid_argument("CameraRays: the camera's eye, target, up or field of view is not a valid number");
    if (length > 0) ahead_ = sight / length;
    // As in scene::View: `up` is not usable if the camera looks along it.
    glm::dvec3 right = glm::cross(ahead_, camera.up);
    if (glm::length(right) < 1e-9) right = glm::cross(ahead_, glm::dvec3(0, 0, -1));
    if (glm::length(right) < 1e-9) right = glm::cross(ahead_, glm::dvec3(1, 0, 0));
    right_ = glm::normalize(right);
    up_ = glm::cross(right_, ahead_);
}

}  // namespace dustbench::bench
