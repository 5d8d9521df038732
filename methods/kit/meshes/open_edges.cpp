#include "methods/kit/meshes/open_edges.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dustbench::meshes {

std::size_t openEdges(const scene::Mesh& mesh) {
    // Corners at the same position get the same number: their rank among all positions.
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::vector<glm::vec3> places(mesh.positions);
    std::sort(places.begin(), places.end(), less);
    std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> edges;
    edges.reserve(mesh.indices.size());
    const auto rank = [&](std::size_t corner) {
        return std::lower_bound(places.begin(), places.end(), mesh.positions[mesh.indices[corner]], less) -
               places.begin();
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::ptrdiff_t a = rank(i + k), b = rank(i + (k + 1) % 3);
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    std::sort(edges.begin(), edges.end());
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t same = i;
        while (same < edges.size() && edges[same] == edges[i]) ++same;
        open += (same - i) % 2;
        i = same;
    }
    return open;
}

}  // namespace dustbench::meshes
