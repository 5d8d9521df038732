// A solid thing in the scene: a triangle mesh, and where it is now.
//
// Units: m, m/s, rad/s; colours: linear RGB. Frame: a mesh is in the object's own, a pose in the world.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace dustbench::scene {

/// Triangles wind counter-clockwise seen from outside.
struct DUSTBENCH_API Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< unit, one a vertex
    std::vector<glm::vec3> colours;      ///< one a vertex
    std::vector<std::uint32_t> indices;  ///< three a triangle

    /// Adds another mesh, moved by `transform` (rotation, translation and uniform scale).
    void append(const Mesh& other, const glm::mat4& transform);
};

/// What does not change: a name and the shape in its own frame.
struct Solid {
    std::string name;
    std::shared_ptr<const Mesh> mesh;
};

/// Where a solid is and how it moves.
struct SolidPose {
    glm::mat4 toWorld{1};
    glm::vec3 velocity{0};         ///< of the object's origin
    glm::vec3 angularVelocity{0};  ///< about the object's origin
};

}  // namespace dustbench::scene
