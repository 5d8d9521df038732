#include "methods/grid_fluid/proxy_mesh.h"

#include <array>
#include <cmath>
#include <map>

namespace dustbench::grid_fluid {

ProxyMesh::ProxyMesh(const scene::Mesh& mesh, float edgeMetres) {
    std::map<std::array<std::int64_t, 3>, std::uint32_t> numbers;
    for (const glm::vec3& p : mesh.positions) {
        const std::array<std::int64_t, 3> cube{std::llround(std::floor(p.x / edgeMetres)),
                                               std::llround(std::floor(p.y / edgeMetres)),
                                               std::llround(std::floor(p.z / edgeMetres))};
        const auto next = static_cast<std::uint32_t>(numbers.size());
        clusters_.push_back(numbers.try_emplace(cube, next).first->second);
    }
    sizes_.assign(numbers.size(), 0);
    for (const std::uint32_t cluster : clusters_) ++sizes_[cluster];
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = clusters_[mesh.indices[i]], b = clusters_[mesh.indices[i + 1]],
                            c = clusters_[mesh.indices[i + 2]];
        if (a != b && b != c && c != a) proxy_.indices.insert(proxy_.indices.end(), {a, b, c});
    }
    takeMeans(mesh.positions, proxy_.positions);
}

void ProxyMesh::takeMeans(std::span<const glm::vec3> values, std::vector<glm::vec3>& means) const {
    std::vector<glm::dvec3> sums(sizes_.size(), glm::dvec3(0));
    for (std::size_t v = 0; v < values.size(); ++v) sums[clusters_[v]] += glm::dvec3(values[v]);
    means.resize(sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) means[k] = glm::vec3(sums[k] / static_cast<double>(sizes_[k]));
}

void ProxyMesh::follow(const scene::Mesh& mesh, std::span<const glm::vec3> velocities) {
    takeMeans(mesh.positions, proxy_.positions);
    velocities_.clear();
    if (!velocities.empty()) takeMeans(velocities, velocities_);
}

}  // namespace dustbench::grid_fluid
