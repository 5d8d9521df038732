#include "methods/voxel_shape/voxels/slice_voxels.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/triangle_bins.h"

namespace dustbench::voxel_shape {
namespace {

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
