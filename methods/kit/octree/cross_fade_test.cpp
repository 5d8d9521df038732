#include "methods/kit/octree/voxel_cloud.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dustbench::octree {
namespace {

/// A cloud of one voxel on a lattice.
VoxelCloud oneVoxel(MemoryLedger& ledger, const Lattice& lattice, const glm::uvec3& cell, float mass) {
    VoxelCloud cloud(ledger);
    cloud.lattice = lattice;
    cloud.resize(1, false);
    cloud.place[0] = CellEntry(mortonCode(cell.x, cell.y, cell.z), 0, 0).place();
    cloud.mass[0] = mass;
    cloud.age[0] = 0;
    cloud.locate(0);
    return cloud;
}

TEST(CrossFade, FollowsByTheLawOfItsTimeConstant) {
    MemoryLedger ledger;
    const Lattice lattice;
    CrossFade fade(ledger, 0.2);
    VoxelCloud nothing(ledger);
    nothing.lattice = lattice;
    fade.follow(nothing, 0.05);
    const VoxelCloud target = oneVoxel(ledger, lattice, {3, 4, 5}, 0.5f);
    for (int n = 1; n <= 8; ++n) {
        const VoxelCloud& shown = fade.follow(target, 0.05);
        ASSERT_EQ(shown.size(), 1u);
        EXPECT_NEAR(shown.mass[0], 0.5 * (1 - std::exp(-n * 0.05 / 0.2)), 1e-6);
    }
    const float held = fade.follow(target, 0.05).mass[0];
    EXPECT_NEAR(fade.follow(nothing, 0.05).mass[0], static_cast<double>(held) * std::exp(-0.05 / 0.2), 1e-6);
    for (int n = 0; n < 100; ++n) fade.follow(nothing, 0.05);
    EXPECT_EQ(fade.follow(nothing, 0.05).size(), 0u);  // the voxel is gone
}

TEST(CrossFade, StaysWhereItIsWhileTheWorldMoves) {
    MemoryLedger ledger;
    Lattice lattice;
    lattice.origin = glm::dvec3(-64);
    CrossFade fade(ledger, 0.2);
    fade.follow(oneVoxel(ledger, lattice, {130, 128, 120}, 1), 0.05);
    const float x = fade.follow(oneVoxel(ledger, lattice, {130, 128, 120}, 1), 0.05).x[0];
    Lattice moved = lattice;
    moved.origin.x += 4;  // shifted by eight finest cells
    const VoxelCloud& shown = fade.follow(oneVoxel(ledger, moved, {122, 128, 120}, 1), 0.05);
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_NEAR(shown.mass[0], 1, 1e-6);
    EXPECT_EQ(shown.x[0], x);
    // In a world twice as wide, with one more level.
    Lattice grown = moved;
    grown.origin -= 64;
    grown.edgeMetres = 256;
    grown.depth = 9;
    const VoxelCloud& same = fade.follow(oneVoxel(ledger, grown, {250, 256, 248}, 1), 0.05);
    ASSERT_EQ(same.size(), 1u);
    EXPECT_NEAR(same.mass[0], 1, 1e-6);
    EXPECT_EQ(same.x[0], x);
    fade.follow(oneVoxel(ledger, moved, {122, 128, 120}, 1), 0.05);
    // Outside the world: dropped.
    moved.origin.x += 256;
    VoxelCloud nothing(ledger);
    nothing.lattice = moved;
    EXPECT_EQ(fade.follow(nothing, 0.05).size(), 0u);
}

}  // namespace
}  // namespace dustbench::octree
