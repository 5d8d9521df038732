#include "methods/voxel_shape/collision/mesh_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace dustbench::voxel_shape {
namespace {

/// Disjoint sets of numbers; a set is represented by its minimum.
class Groups {
 public:
    explicit Groups(std::size_t count) : leader_(count) { std::iota(leader_.begin(), leader_.end(), std::size_t{0}); }
    [[nodiscard]] std::size_t of(std::size_t i) {
        while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
        return i;
    }
    /// Joins two sets; returns whether they were separate.
    bool join(std::size_t a, std::size_t b) {
        a = of(a), b = of(b);
        leader_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

 private:
    std::vector<std::size_t> leader_;
};

struct Box {
    glm::vec3 minimum{INFINITY}, maximum{-INFINITY};
    [[nodiscard]] bool meets(const Box& other) const {
        return glm::all(glm::lessThanEqual(minimum, other.maximum)) &&
               glm::all(glm::lessThanEqual(other.minimum, maximum));
    }
};

}  // namespace

std::vector<scene::Mesh> partsOf(const scene::Mesh& mesh) {
    const std::size_t triangles = mesh.indices.size() / 3;
    Groups groups(triangles);
    std::map<std::array<float, 3>, std::size_t> firstAt;
    for (std::size_t t = 0; t < triangles; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& p = mesh.positions[mesh.indices[3 * t + k]];
            groups.join(t, firstAt.try_emplace({p.x, p.y, p.z}, t).first->second);
        }
    // Repeat until no two boxes overlap: a box that has grown may overlap more.
    for (bool joined = true; joined;) {
        joined = false;
        std::map<std::size_t, Box> boxes;
        for (std::size_t t = 0; t < triangles; ++t) {
            Box& box = boxes[groups.of(t)];
            for (std::size_t k = 0; k < 3; ++k) {
                box.minimum = glm::min(box.minimum, mesh.positions[mesh.indices[3 * t + k]]);
                box.maximum = glm::max(box.maximum, mesh.positions[mesh.indices[3 * t + k]]);
            }
        }
        for (auto a = boxes.begin(); a != boxes.end(); ++a)
            for (auto b = std::next(a); b != boxes.end(); ++b)
                if (a->second.meets(b->second)) joined = groups.join(a->first, b->first) || joined;
    }

    std::map<std::size_t, scene::Mesh> parts;
    const bool coloured = mesh.colours.size() == mesh.positions.size();
    for (std::size_t t = 0; t < triangles; ++t) {
        scene::Mesh& part = parts[groups.of(t)];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[3 * t + k];
            part.indices.push_back(static_cast<std::uint32_t>(part.positions.size()));
            part.positions.push_back(mesh.positions[vertex]);
            if (coloured) part.colours.push_back(mesh.colours[vertex]);
        }
    }
    std::vector<scene::Mesh> list;
    list.reserve(parts.size());
    for (auto& [first, part] : parts) list.push_back(std::move(part));
    return list;
}

}  // namespace dustbench::voxel_shape
