// A solid object in the scene: a triangle mesh and its current pose.
//
// Units: m, m/s, rad/s; colours: linear RGB. Frame: meshes in the object's frame, poses in the world.
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
    std::vector<glm::vec3> normals;      ///< unit, one per vertex
    std::vector<glm::vec3> colours;      ///< one per vertex
    std::vector<std::uint32_t> indices;  ///< three per triangle

    /// Appends another mesh, transformed by `transform` (rotation, translation and uniform scale).
    void append(const Mesh& other, const glm::mat4& transform);
};

/// The constant part of a solid: its name and its shape in its own frame.
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
