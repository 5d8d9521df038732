// A solid thing in the scene: a mesh and where it is now.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "methods/shared/scene/mesh.h"

namespace dustbench::scene {

/// What does not change: a name and the shape in its own frame.
struct Solid {
    std::string name;
    std::shared_ptr<const Mesh> mesh;
};

/// Where a solid is and how it moves. Units: m, m/s, rad/s. Frame: world.
struct SolidPose {
    glm::mat4 toWorld{1};
    glm::vec3 velocity{0};         ///< of the object's origin
    glm::vec3 angularVelocity{0};  ///< about the object's origin
};

}  // namespace dustbench::scene
