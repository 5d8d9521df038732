#include "methods/voxel_shape/voxels/surface_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::voxel_shape {
namespace {

struct Triangle {
    std::array<glm::vec3, 3> corners;
    std::array<glm::vec3, 3> colours;

    [[nodiscard]] glm::vec3 minimum() const { return glm::min(glm::min(corners[0], corners[1]), corners[2]); }
    [[nodiscard]] glm::vec3 maximum() const { return glm::max(glm::max(corners[0], corners[1]), corners[2]); }
};

/// The triangles of a mesh in voxels from the lattice's minimum corner, sorted by the lattice layers that they reach,
/// so that each layer can have its own thread.
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

/// Overlap test of a triangle and a unit cube by separating axes: the triangle's plane, and its edges projected along
/// x, y and z. The cube is [cell, cell + 1] on each axis in voxels, widened by `margin`. Holds the terms that depend
/// only on the triangle, for many cubes. The caller checks the bounding boxes. Source: Schwarz2010, 3.1 (plane and
/// projected edge functions against a box's critical points).
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
glm::vec3 nearestWeights(const Triangle& triangle, const glm::vec3& point) {
    const auto& v = triangle.corners;
    const glm::vec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    const float area = glm::dot(normal, normal);
    if (!(area > 0)) return glm::vec3(1.0f / 3);
    const float first = glm::dot(glm::cross(v[2] - v[1], point - v[1]), normal) / area;
    const float second = glm::dot(glm::cross(v[0] - v[2], point - v[2]), normal) / area;
    const glm::vec3 weights = glm::max(glm::vec3(first, second, 1 - first - second), glm::vec3(0));
    return weights / (weights.x + weights.y + weights.z);
}

constexpr float margin = 1.0f / 256;

/// Marks the voxels of one layer that triangles touch. `hits` is scratch for one layer.
void markLayer(const TriangleBins& bins, int layer, MarkedVoxels& result, std::vector<float>& hits) {
    const Lattice& lattice = result.lattice;
    const std::size_t first = lattice.index({0, 0, layer});
    std::ranges::fill(hits, 0.0f);
    for (const std::uint32_t number : bins.inLayer(static_cast<std::size_t>(layer))) {
        const Triangle& triangle = bins.triangle(number);
        const TriangleOverlap overlap(triangle, margin);
        const glm::ivec3 minimum = glm::max(glm::ivec3(glm::floor(triangle.minimum() - margin)), glm::ivec3(0));
        const glm::ivec3 maximum = glm::min(glm::ivec3(glm::floor(triangle.maximum() + margin)), lattice.counts - 1);
        for (int y = minimum.y; y <= maximum.y; ++y)
            for (int x = minimum.x; x <= maximum.x; ++x) {
                if (!overlap.overlaps({x, y, layer})) continue;
                const std::uint32_t voxel = lattice.index({x, y, layer});
                const glm::vec3 weights = nearestWeights(triangle, glm::vec3(x, y, layer) + 0.5f);
                result.marked[voxel] = 1;
                result.colours[voxel] +=
                    weights.x * triangle.colours[0] + weights.y * triangle.colours[1] + weights.z * triangle.colours[2];
                hits[voxel - first] += 1;
            }
    }
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i] > 0) result.colours[first + i] /= hits[i];
}

/// Corners projected along z, in steps of 1/256 pixel as in rasterisers, which makes areas exact.
using Snapped = glm::i64vec2;
constexpr float stepsAPixel = 256;

Snapped snapped(const glm::vec3& corner) {
    return {std::llround(corner.x * stepsAPixel), std::llround(corner.y * stepsAPixel)};
}

/// Returns twice the signed area of the triangle a, b, p.
std::int64_t area(const Snapped& a, const Snapped& b, const Snapped& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Top-left rule: a pixel centre on an edge belongs to the triangle if the edge is its left or bottom one, in
/// counter-clockwise order.
bool takesItsEdge(const Snapped& a, const Snapped& b) {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
}

/// Marks the voxels in one row of constant y that triangles meet. `depths` is scratch for the voxels of a row, x
/// fastest.
void markRow(const TriangleBins& bins, int row, MarkedVoxels& result, std::vector<float>& depths) {
    const Lattice& lattice = result.lattice;
    depths.assign(depths.size(), -std::numeric_limits<float>::infinity());
    for (const std::uint32_t number : bins.inLayer(static_cast<std::size_t>(row))) {
        const Triangle& triangle = bins.triangle(number);
        const auto& v = triangle.corners;
        const std::array<Snapped, 3> p{snapped(v[0]), snapped(v[1]), snapped(v[2])};
        const std::int64_t whole = area(p[0], p[1], p[2]);
        if (whole == 0) continue;  // edge-on
        const std::int64_t side = whole > 0 ? 1 : -1;
        const int last = std::min(static_cast<int>(std::floor(triangle.maximum().x + 1)), lattice.counts.x - 1);
        for (int x = std::max(static_cast<int>(std::floor(triangle.minimum().x - 1)), 0); x <= last; ++x) {
            const Snapped middle(256 * x + 128, 256 * row + 128);
            bool within = true;
            std::array<float, 3> weights{};
            for (std::size_t k = 0; k < 3; ++k) {
                const Snapped &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
                const std::int64_t part = side * area(a, b, middle);
                within = within && (part > 0 || (part == 0 && (side > 0 ? takesItsEdge(a, b) : takesItsEdge(b, a))));
                weights[k] = static_cast<float>(part) / static_cast<float>(side * whole);
            }
            if (!within) continue;
            const float z = weights[0] * v[0].z + weights[1] * v[1].z + weights[2] * v[2].z;
            const int layer = static_cast<int>(std::floor(z));
            if (layer < 0 || layer >= lattice.counts.z) continue;
            float& depth = depths[static_cast<std::size_t>(layer * lattice.counts.x + x)];
            if (!(z > depth)) continue;
            depth = z;
            const std::uint32_t voxel = lattice.index({x, row, layer});
            result.marked[voxel] = 1;
            result.colours[voxel] =
                weights[0] * triangle.colours[0] + weights[1] * triangle.colours[1] + weights[2] * triangle.colours[2];
        }
    }
}

}  // namespace

MarkedVoxels surfaceVoxels(const scene::Mesh& mesh, const Lattice& lattice) {
    const TriangleBins bins(mesh, lattice, 2, margin);
    MarkedVoxels result(lattice);
    const auto layerSize = static_cast<std::size_t>(lattice.counts.x) * static_cast<std::size_t>(lattice.counts.y);
    const auto layers = static_cast<std::size_t>(lattice.counts.z);
    parallel::forEachBlock(layers, 1, [&](std::size_t layer, std::size_t) {
        std::vector<float> hits(layerSize);
        markLayer(bins, static_cast<int>(layer), result, hits);
    });
    return result;
}

MarkedVoxels sliceVoxels(const scene::Mesh& mesh, const Lattice& lattice) {
    const TriangleBins bins(mesh, lattice, 1, 1 / stepsAPixel);
    MarkedVoxels result(lattice);
    const auto rowSize = static_cast<std::size_t>(lattice.counts.x) * static_cast<std::size_t>(lattice.counts.z);
    parallel::forEachBlock(static_cast<std::size_t>(lattice.counts.y), 1, [&](std::size_t row, std::size_t) {
        std::vector<float> depths(rowSize);
        markRow(bins, static_cast<int>(row), result, depths);
    });
    return result;
}

}  // namespace dustbench::voxel_shape
