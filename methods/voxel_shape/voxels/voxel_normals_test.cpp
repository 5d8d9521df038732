#include "methods/voxel_shape/voxels/voxel_normals.h"

#include <gtest/gtest.h>

#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

TEST(VoxelNormals, OfASphereLookAwayFromItsMiddle) {
    MemoryLedger ledger;
    const scene::Mesh sphere = sphereMesh(1, 40);
    for (const int resolution : {16, 30, 60}) {
        const VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, resolution)), Voxel());
        const std::vector<glm::vec3> normals = normalsOf(grid);
        double sum = 0;
        for (std::size_t k = 0; k < normals.size(); ++k) {
            const glm::vec3 radial = glm::normalize(grid.lattice().centre(grid.lattice().cell(grid.active()[k])));
            EXPECT_GT(glm::dot(normals[k], radial), 0.7f) << "within 45 degrees";
            sum += static_cast<double>(glm::dot(normals[k], radial));
        }
        EXPECT_GT(sum / static_cast<double>(normals.size()), 0.96) << "within 16 degrees on average";
    }
}

TEST(VoxelNormals, AreNoneWhereMatterIsTheSameOnAllSides) {
    MemoryLedger ledger;
    MarkedVoxels marked(Lattice{{1, 1, 1}, glm::vec3(0), 1});
    marked.marked[0] = 1;
    EXPECT_EQ(normalsOf(VoxelGrid(ledger, marked, Voxel()))[0], glm::vec3(0));
}

}  // namespace
}  // namespace dustbench::voxel_shape
