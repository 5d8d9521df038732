// A triangle mesh as plain arrays.
//
// Units: metres. Frame: the object's own. Colours: linear RGB. Triangles wind counter-clockwise seen from outside.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace dustbench::scene {

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< unit, one a vertex
    std::vector<glm::vec3> colours;      ///< one a vertex
    std::vector<std::uint32_t> indices;  ///< three a triangle

    /// Adds another mesh, moved by `transform` (rotation, translation and uniform scale).
    void append(const Mesh& other, const glm::mat4& transform);
};

}  // namespace dustbench::scene
