#include "methods/contract/solid.h"

#include <stdexcept>

namespace dustbench::scene {

void Mesh::append(const Mesh& other, const glm::mat4& transform) {
    if (&other == this) throw std::invalid_argument("Mesh::append: a mesh cannot be added to itself");
    const auto first = static_cast<std::uint32_t>(positions.size());
    const glm::mat3 turn(transform);
    for (const glm::vec3& position : other.positions)
        positions.push_back(glm::vec3(transform * glm::vec4(position, 1)));
    for (const glm::vec3& normal : other.normals) normals.push_back(glm::normalize(turn * normal));
    colours.insert(colours.end(), other.colours.begin(), other.colours.end());
    for (const std::uint32_t index : other.indices) indices.push_back(first + index);
}

}  // namespace dustbench::scene
