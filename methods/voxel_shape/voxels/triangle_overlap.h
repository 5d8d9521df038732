// Overlap test of a triangle and a unit cube by separating axes: the triangle's plane, and its edges projected along x,
// y and z.
//
// Units: voxels; the cube is [cell, cell + 1] on each axis, widened by `margin`. Threads: pure.
// Source: Schwarz2010, 3.1 (plane and projected edge functions against a box's critical points).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/voxel_shape/voxels/triangle_bins.h"

namespace dustbench::voxel_shape {

/// The terms of the test that depend only on the triangle, for many cubes. The caller checks the bounding boxes.
class TriangleOverlap {
 public:
    TriangleOverlap(const Triangle& triangle, float margin) {
        const auto& v = triangle.corners;
        const float half = 0.5f + margin;
        const std::array<glm::vec3, 3> edges{v[1] - v[0], v[2] - v[1], v[0] - v[2]};
        normal_ = glm::cross(edges[0], v[2] - v[0]);
        // |n·(centre − v0)| ≤ half·(|n.x| + |n.y| + |n.z|)
        planeReach_ = half * (std::abs(normal_.x) + std::abs(normal_.y) + std::abs(normal_.z));
        planeOffset_ = glm::dot(normal_, v[0]);
        for (std::size_t along = 0; along < 3; ++along) {
            const int a = static_cast<int>(along + 1) % 3, b = static_cast<int>(along + 2) % 3;
            // The edge normals point into the triangle for either winding.
            const float side = normal_[static_cast<int>(along)] >= 0 ? 1.0f : -1.0f;
            for (std::size_t e = 0; e < 3; ++e) {
                const glm::vec2 inwards = side * glm::vec2(-edges[e][b], edges[e][a]);
                const float atCorner = inwards.x * v[e][a] + inwards.y * v[e][b];
                // inwards·centre + half·(|inwards|₁) ≥ inwards·v
                lines_[along][e] = {inwards, half * (std::abs(inwards.x) + std::abs(inwards.y)) - atCorner};
            }
        }
    }

    [[nodiscard]] bool overlaps(const glm::ivec3& cell) const {
        const glm::vec3 centre = glm::vec3(cell) + 0.5f;
        if (std::abs(glm::dot(normal_, centre) - planeOffset_) > planeReach_) return false;
        for (std::size_t along = 0; along < 3; ++along) {
            const int a = static_cast<int>(along + 1) % 3, b = static_cast<int>(along + 2) % 3;
            for (const Line& line : lines_[along])
                if (line.inwards.x * centre[a] + line.inwards.y * centre[b] + line.offset < 0) return false;
        }
        return true;
    }

 private:
    struct Line {
        glm::vec2 inwards;
        float offset;
    };
    glm::vec3 normal_;
    float planeReach_, planeOffset_;
    std::array<std::array<Line, 3>, 3> lines_;  ///< projected along x, y, z
};

/// Returns the barycentric weights of the point of a triangle nearest to `point`: those of the foot of the
/// perpendicular, clamped to the triangle. Exact inside the triangle; outside, accurate enough for colours.
[[nodiscard]] inline glm::vec3 nearestWeights(const Triangle& triangle, const glm::vec3& point) {
    const auto& v = triangle.corners;
    const glm::vec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    const float area = glm::dot(normal, normal);
    if (!(area > 0)) return glm::vec3(1.0f / 3);
    const float first = glm::dot(glm::cross(v[2] - v[1], point - v[1]), normal) / area;
    const float second = glm::dot(glm::cross(v[0] - v[2], point - v[2]), normal) / area;
    const glm::vec3 weights = glm::max(glm::vec3(first, second, 1 - first - second), glm::vec3(0));
    return weights / (weights.x + weights.y + weights.z);
}

}  // namespace dustbench::voxel_shape
