#include "methods/voxel_shape/collision/nearness.h"

#include <algorithm>
#include <cmath>

#include "methods/voxel_shape/voxels/solid_fill.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"

namespace dustbench::voxel_shape {
namespace {

constexpr int maximumCells = 128;

MarkedVoxels surfaceOf(const scene::Mesh& mesh, float cellMetres) {
    const Lattice one = latticeAround(mesh, 1);  // its edge is the longest side
    const int cells = std::clamp(static_cast<int>(std::ceil(one.edgeMetres / cellMetres)), 1, maximumCells);
    return surfaceVoxels(mesh, latticeAround(mesh, cells));
}

}  // namespace

Nearness::Nearness(const scene::Mesh& mesh, float cellMetres, float reachMetres) {
    MarkedVoxels solid = surfaceOf(mesh, cellMetres);
    const std::vector<std::uint8_t> onSurface = solid.marked;
    (void)markInside(solid);  // a mesh that encloses nothing keeps only its surface
    const float edge = solid.lattice.edgeMetres;
    const float reach = reachMetres / edge + std::sqrt(3.0f) / 2;  // in cells, from centre to centre
    const int rim = static_cast<int>(std::ceil(reach));
    lattice_ = {solid.lattice.counts + 2 * rim, solid.lattice.origin - edge * static_cast<float>(rim), edge};
    near_.assign(lattice_.size(), 0);
    std::vector<glm::ivec3> ball;
    for (int z = -rim; z <= rim; ++z)
        for (int y = -rim; y <= rim; ++y)
            for (int x = -rim; x <= rim; ++x)
                if (glm::length(glm::vec3(x, y, z)) <= reach) ball.emplace_back(x, y, z);
    for (std::uint32_t i = 0; i < solid.marked.size(); ++i) {
        if (!solid.marked[i]) continue;
        const glm::ivec3 cell = solid.lattice.cell(i) + rim;
        near_[lattice_.index(cell)] = 1;
        if (!onSurface[i]) continue;
        for (const glm::ivec3& step : ball) near_[lattice_.index(cell + step)] = 1;
    }
}

}  // namespace dustbench::voxel_shape
