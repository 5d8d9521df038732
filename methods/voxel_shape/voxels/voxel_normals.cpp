#include "methods/voxel_shape/voxels/voxel_normals.h"

#include "methods/kit/parallel/for_each_block.h"
#include "methods/voxel_shape/voxels/solid_fill.h"

namespace dustbench::voxel_shape {
namespace {

constexpr int reach = 2;
constexpr std::size_t voxelsABlock = 256;

/// Returns −Σ d/|d|² over the matter at offsets d within reach.
glm::vec3 awayFromMatter(const MarkedVoxels& matter, const glm::ivec3& cell) {
    glm::vec3 sum(0);
    for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const glm::ivec3 d(x, y, z);
                if (d == glm::ivec3(0) || !matter.lattice.contains(cell + d)) continue;
                const glm::vec3 along(d);
                if (matter.marked[matter.lattice.index(cell + d)]) sum -= along / glm::dot(along, along);
            }
    return sum;
}

}  // namespace

std::vector<glm::vec3> normalsOf(const VoxelGrid& grid) {
    MarkedVoxels matter(grid.lattice());
    for (const std::uint32_t i : grid.active()) matter.marked[i] = 1;
    (void)markInside(matter);
    std::vector<glm::vec3> normals(grid.active().size(), glm::vec3(0));
    parallel::forEachBlock(normals.size(), voxelsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const glm::vec3 away = awayFromMatter(matter, grid.lattice().cell(grid.active()[k]));
            const float length = glm::length(away);
            if (length > 1e-3f) normals[k] = away / length;
        }
    });
    return normals;
}

}  // namespace dustbench::voxel_shape
