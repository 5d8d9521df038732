#include "methods/voxel_shape/shape_light.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

VoxelGrid greySphere(MemoryLedger& ledger) {
    const scene::Mesh sphere = sphereMesh(1, 40);
    VoxelGrid grid(ledger, surfaceVoxels(sphere, latticeAround(sphere, 40)), Voxel());
    for (const std::uint32_t i : grid.active()) {
        grid.voxels()[i].colour = PackedColour({0.5f, 0.5f, 0.5f, 0.4f});
        grid.voxels()[i].fadingColour = PackedColour({0.25f, 0.25f, 0.25f, 0.1f});
    }
    return grid;
}

scene::Lights sunAlong(const glm::vec3& toSun) {
    scene::Lights lights;
    lights.toSun = toSun;
    lights.sun = glm::vec3(0.8f);
    lights.ambient = glm::vec3(0.2f);
    return lights;
}

/// Checks that the side towards the sun has ambient + sun, and the opposite side only ambient.
void expectLitFrom(const VoxelGrid& grid, const glm::vec3& direction) {
    float front = 0, back = 1;
    for (const std::uint32_t i : grid.active()) {
        const float height = glm::dot(grid.lattice().centre(grid.lattice().cell(i)), direction);
        const float shown = grid.voxels()[i].colour.colour().r;
        if (height > 0.9f) front = std::max(front, shown);
        if (height < -0.3f) back = std::min(back, shown);
        EXPECT_NEAR(grid.voxels()[i].colour.colour().a, 0.4f, 1e-4f);
        EXPECT_NEAR(grid.voxels()[i].fadingColour.colour().r, shown / 2, 1e-4f) << "half as bright, in the same light";
    }
    EXPECT_NEAR(front, 0.5f * (0.2f + 0.8f), 0.01f);
    EXPECT_NEAR(back, 0.5f * 0.2f, 0.01f);
}

TEST(ShapeLight, ShowsSunAndSkyBeforeAndTheSkyAloneBehind) {
    MemoryLedger ledger;
    VoxelGrid grid = greySphere(ledger);
    ShapeLight light(ledger, grid, sunAlong({0, 1, 0}));
    light.shineOn(grid, {});
    expectLitFrom(grid, {0, 1, 0});
}

TEST(ShapeLight, StandsStillWhereTheShapeTurns) {
    MemoryLedger ledger;
    VoxelGrid grid = greySphere(ledger);
    ShapeLight light(ledger, grid, sunAlong({0, 1, 0}));
    light.shineOn(grid, {});
    Pose pose;
    pose.rotation = glm::mat3(glm::rotate(glm::mat4(1), glm::radians(90.0f), {0, 0, 1}));
    light.shineOn(grid, pose);
    expectLitFrom(grid, glm::transpose(pose.rotation) * glm::vec3(0, 1, 0));
    light.shineOn(grid, {});
    expectLitFrom(grid, {0, 1, 0});
}

}  // namespace
}  // namespace dustbench::voxel_shape
