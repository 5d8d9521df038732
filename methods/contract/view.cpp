#include "methods/contract/view.h"

#include <cmath>

namespace dustbench::scene {
namespace {

/// The camera's axes in the world: right, up, and forward from the eye to the target.
struct Axes {
    glm::dvec3 right, up, forward;
};

Axes axesOf(const Camera& camera) {
    const glm::dvec3 sight = camera.target - camera.eye;
    const double distance = glm::length(sight);
    const glm::dvec3 forward = distance > 0 ? sight / distance : glm::dvec3(0, 0, -1);
    glm::dvec3 right = glm::cross(forward, camera.up);
    if (glm::length(right) < 1e-9) right = glm::cross(forward, glm::dvec3(0, 0, -1));  // looking along `up`
    if (glm::length(right) < 1e-9) right = glm::cross(forward, glm::dvec3(1, 0, 0));
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), forward};
}

}  // namespace

glm::mat4 View::worldToEye() const {
    const auto [right, up, forward] = axesOf(camera);
    // The rows are the axes; −forward is eye z: p_eye = R (p − eye).
    glm::dmat4 matrix(1);
    for (int i = 0; i < 3; ++i) {
        matrix[i][0] = right[i];
        matrix[i][1] = up[i];
        matrix[i][2] = -forward[i];
    }
    matrix[3] = {-glm::dot(right, camera.eye), -glm::dot(up, camera.eye), glm::dot(forward, camera.eye), 1};
    return glm::mat4(matrix);
}

glm::mat4 View::eyeToClip() const {
    // With f = 1 / tan(fov/2), a = width/height and near n:
    //   x_c = f x / a,  y_c = f y,  z_c = n,  w_c = −z   ⇒   depth = z_c / w_c = n / (−z): 1 at the near plane, 0 at ∞.
    const double focal = 1 / std::tan(camera.verticalFieldOfView / 2);
    glm::dmat4 matrix(0);
    matrix[0][0] = focal * height / width;
    matrix[1][1] = focal;
    matrix[2][3] = -1;
    matrix[3][2] = camera.nearMetres;
    return glm::mat4(matrix);
}

glm::vec3 View::rayDirection(double pixelX, double pixelY) const {
    const auto [right, up, forward] = axesOf(camera);
    const double slope = std::tan(camera.verticalFieldOfView / 2);
    const double x = (2 * pixelX / width - 1) * slope * width / height;
    const double y = (1 - 2 * pixelY / height) * slope;
    return glm::vec3(glm::normalize(forward + x * right + y * up));
}

}  // namespace dustbench::scene
