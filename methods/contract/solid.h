// A solid object in the scene: a triangle mesh, its pose and its shape at one moment.
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

/// Which part of a solid changes with time.
enum class SolidMotion {
    still,    ///< nothing
    moves,    ///< its pose
    deforms,  ///< its shape, and perhaps its pose
};

/// The constant part of a solid: its name and its shape in its own frame.
struct Solid {
    std::string name;
    std::shared_ptr<const Mesh> mesh;  ///< for a deforming solid: at rest
    SolidMotion motion = SolidMotion::still;
};

/// Where a solid is and how it moves.
struct SolidPose {
    glm::mat4 toWorld{1};
    glm::vec3 velocity{0};         ///< of the object's origin
    glm::vec3 angularVelocity{0};  ///< about the object's origin
};

/// The shape of a deforming solid at one moment.
struct DeformedMesh {
    Mesh mesh;                          ///< vertices in the same number, same triangles as Solid::mesh
    std::vector<glm::vec3> velocities;  ///< of the positions, in the object's frame
};

/// A solid at one moment.
struct SolidNow {
    SolidPose pose;
    std::shared_ptr<const DeformedMesh> shape{};  ///< for a deforming solid; null: at rest
};

}  // namespace dustbench::scene
