// The triangles of a mesh, sorted by the lattice layers that they reach, so that each layer can have its own thread.
//
// Units: voxels from the lattice's minimum corner. Owns: its lists.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

struct Triangle {
    std::array<glm::vec3, 3> corners;
    std::array<glm::vec3, 3> colours;

    [[nodiscard]] glm::vec3 minimum() const { return glm::min(glm::min(corners[0], corners[1]), corners[2]); }
    [[nodiscard]] glm::vec3 maximum() const { return glm::max(glm::max(corners[0], corners[1]), corners[2]); }
};

class TriangleBins {
 public:
    /// Bins by layers along `axis` (0, 1, 2). `margin` widens each triangle. A mesh without colours is white.
    TriangleBins(const scene::Mesh& mesh, const Lattice& lattice, int axis, float margin);

    [[nodiscard]] const Triangle& triangle(std::uint32_t number) const { return triangles_[number]; }
    /// Indices of the triangles that reach a layer, ascending.
    [[nodiscard]] std::span<const std::uint32_t> inLayer(std::size_t layer) const {
        return {numbers_.data() + starts_[layer], starts_[layer + 1] - starts_[layer]};
    }

 private:
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> numbers_;
};

}  // namespace dustbench::voxel_shape
