#include "methods/contract/vehicle.h"

#include <cmath>

namespace dustbench::scene {

glm::dvec3 VehicleState::forward() const {
    // Seen from above, forward follows the heading; the slope s makes it tangent to the ground: (x, s, z) · up = 0.
    const double x = std::cos(heading);
    const double z = -std::sin(heading);
    return glm::normalize(glm::dvec3(x, -(x * up.x + z * up.z) / up.y, z));
}

glm::dmat4 VehicleState::toWorld() const {
    const glm::dvec3 ahead = forward();
    glm::dmat4 matrix(1);
    matrix[0] = glm::dvec4(ahead, 0);
    matrix[1] = glm::dvec4(up, 0);
    matrix[2] = glm::dvec4(glm::cross(ahead, up), 0);
    matrix[3] = glm::dvec4(position, 1);
    return matrix;
}

}  // namespace dustbench::scene
