#include "methods/voxel_shape/voxels/triangle_bins.h"

#include <algorithm>
#include <cmath>

namespace dustbench::voxel_shape {

TriangleBins::TriangleBins(const scene::Mesh& mesh, const Lattice& lattice, int axis, float margin) {
    requireSoundMesh(mesh, "voxels of a mesh");
    const bool coloured = mesh.colours.size() == mesh.positions.size();
    triangles_.reserve(mesh.indices.size() / 3);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Triangle triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[i + k];
            triangle.corners[k] = lattice.toVoxels(mesh.positions[vertex]);
            triangle.colours[k] = coloured ? mesh.colours[vertex] : glm::vec3(1);
        }
        triangles_.push_back(triangle);
    }

    const int layers = lattice.counts[axis];
    const auto reached = [&](const Triangle& triangle) {
        const auto first = static_cast<int>(std::floor(triangle.minimum()[axis] - margin));
        const auto last = static_cast<int>(std::floor(triangle.maximum()[axis] + margin));
        return std::pair(std::max(first, 0), std::min(last, layers - 1));
    };
    starts_.assign(static_cast<std::size_t>(layers) + 1, 0);
    for (const Triangle& triangle : triangles_)
        for (auto [layer, last] = reached(triangle); layer <= last; ++layer)
            ++starts_[static_cast<std::size_t>(layer) + 1];
    for (std::size_t layer = 0; layer < static_cast<std::size_t>(layers); ++layer) starts_[layer + 1] += starts_[layer];
    numbers_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t number = 0; number < triangles_.size(); ++number)
        for (auto [layer, last] = reached(triangles_[number]); layer <= last; ++layer)
            numbers_[next[static_cast<std::size_t>(layer)]++] = number;
}

}  // namespace dustbench::voxel_shape
