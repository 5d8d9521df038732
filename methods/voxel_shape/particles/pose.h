// Position, orientation and scale of a shape, and their rates of change.
//
// Units: m, m/s, rad/s, 1/s. Frame: the world; local points are in the shape's own. Threads: pure.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::voxel_shape {

struct Pose {
    glm::mat3 rotation{1};
    glm::vec3 position{0};  ///< of the shape's origin
    float scale = 1;
    glm::vec3 velocity{0};  ///< of the shape's origin
    glm::vec3 angularVelocity{0};
    float growth = 0;  ///< relative change of scale per second

    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& local) const { return position + scale * (rotation * local); }
    [[nodiscard]] glm::vec3 toLocal(const glm::vec3& world) const {
        return glm::transpose(rotation) * (world - position) / scale;
    }
    /// Velocity of the shape's material at a point of the world; newborn particles start with it.
    [[nodiscard]] glm::vec3 velocityAt(const glm::vec3& world) const {
        return velocity + glm::cross(angularVelocity, world - position) + growth * (world - position);
    }
};

}  // namespace dustbench::voxel_shape
