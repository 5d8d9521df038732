#include "methods/kit/meshes/morph_mesh.h"

#include <stdexcept>

namespace dustbench::meshes {
namespace {

/// Vertex normals: the mean of the surrounding triangles, weighted by area.
void computeNormals(scene::Mesh& mesh) {
    std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::vec3 area = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t corner : {a, b, c}) sums[corner] += area;
    }
    for (std::size_t v = 0; v < sums.size(); ++v)
        if (const float length = glm::length(sums[v]); length > 0) mesh.normals[v] = sums[v] / length;
}

}  // namespace

scene::DeformedMesh deformed(const MorphMesh& morph, std::span<const double> weights,
                             std::span<const double> weightsPerSecond) {
    if (weights.size() != morph.offsets.size() || weightsPerSecond.size() != morph.offsets.size())
        throw std::invalid_argument("deformed: expected a weight and its rate for each target");
    scene::DeformedMesh result{morph.rest, std::vector<glm::vec3>(morph.rest.positions.size(), glm::vec3(0))};
    for (std::size_t t = 0; t < weights.size(); ++t) {
        const auto weight = static_cast<float>(weights[t]), perSecond = static_cast<float>(weightsPerSecond[t]);
        for (std::size_t v = 0; v < result.velocities.size(); ++v) {
            result.mesh.positions[v] += weight * morph.offsets[t][v];
            result.velocities[v] += perSecond * morph.offsets[t][v];
        }
    }
    computeNormals(result.mesh);
    return result;
}

}  // namespace dustbench::meshes
