#include "methods/voxel_shape/voxels/surface_voxels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/triangle_bins.h"
#include "methods/voxel_shape/voxels/triangle_overlap.h"

namespace dustbench::voxel_shape {
namespace {

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

}  // namespace dustbench::voxel_shape
