#include "bench/reference/camera_rays.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dustbench::reference {

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

namespace {

std::size_t pixelCount(const scene::View& view) {
    return static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
}

}  // namespace

OpaqueDistances distancesFromDepth(const scene::View& view, std::span<const float> depth) {
    const CameraRays rays(view);
    if (depth.size() != pixelCount(view))
        throw std::invalid_argument(fmt::format("distancesFromDepth: got {} depths, but the view has {}x{} pixels",
                                                depth.size(), view.width, view.height));
    OpaqueDistances distances{view.width, view.height, std::vector<double>(depth.size())};
    for (std::size_t i = 0; i < depth.size(); ++i) {
        const auto reversed = static_cast<double>(depth[i]);
        if (!(reversed >= 0 && reversed <= 1))
            throw std::invalid_argument(
                fmt::format("distancesFromDepth: got the depth {}, expected a reversed depth 0..1", reversed));
        const double x = rays.columnSlope(static_cast<int>(i) % view.width);
        const double y = rays.rowSlope(static_cast<int>(i) / view.width);
        distances.metres[i] = reversed > 0 ? view.camera.nearMetres / reversed * std::sqrt(1 + x * x + y * y)
                                           : std::numeric_limits<double>::infinity();
    }
    return distances;
}

OpaqueDistances skyDistances(const scene::View& view) {
    const CameraRays checked(view);
    return {checked.width(), checked.height(),
            std::vector<double>(pixelCount(view), std::numeric_limits<double>::infinity())};
}

void checkDistances(const scene::View& view, const OpaqueDistances& distances) {
    if (distances.width != view.width || distances.height != view.height || distances.metres.size() != pixelCount(view))
        throw std::invalid_argument(fmt::format("ground truth: {} distances of {}x{} pixels for a view of {}x{}",
                                                distances.metres.size(), distances.width, distances.height, view.width,
                                                view.height));
    for (const double metres : distances.metres)
        if (!(metres >= 0))
            throw std::invalid_argument(
                fmt::format("ground truth: got the distance {} m to the scene, allowed: 0 or more", metres));
}

}  // namespace dustbench::reference
