#include "methods/voxel_shape/particles/crossing.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "methods/voxel_shape/particles/test_ledger.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns a block of 8³ voxels of 0.25 m around a moving point.
ShapeSystem crossedBlock(const Pose& pose, std::uint64_t seed) {
    MarkedVoxels marked(Lattice{{8, 8, 8}, glm::vec3(-1), 0.25f});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    ShapeSystem system(ledger(), marked, Voxel(), seed);
    system.grid().shareOut(5000);
    system.step(pose, {}, dt);
    return system;
}

Pose movingAt(const glm::vec3& position, const glm::vec3& velocity) {
    Pose pose;
    pose.position = position;
    pose.velocity = velocity;
    return pose;
}

TEST(Crossing, DrawsAlongThoseParticlesAloneThatAreInTheOthersVoxels) {
    ShapeSystem still = crossedBlock({}, 1);
    const ShapeSystem moving = crossedBlock(movingAt({1.5f, 0, 0}, {4, 0, 0}), 2);
    const std::size_t met = drawAlong(still, moving, 0.25f);
    std::size_t within = 0;
    const particles::ParticleStore& s = still.particles().store;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const bool inBoth = s.x[i] >= 0.5f;
        EXPECT_EQ(s.velocityX[i], inBoth ? 1.0f : 0.0f) << s.x[i];
        within += inBoth;
    }
    EXPECT_EQ(met, within);
    EXPECT_NEAR(static_cast<double>(met), 1250, 100) << "a quarter of the block";
}

TEST(Crossing, GivesTheVelocityOfTheOthersMatterWhereTheParticleIs) {
    ShapeSystem still = crossedBlock({}, 1);
    Pose pose = movingAt({0.4f, 0.1f, 0}, {1, 0, 0});
    pose.angularVelocity = {0, 3, 1};
    pose.growth = 0.5f;
    const scene::Mesh sphere = sphereMesh(0.7f, 24);
    ShapeSystem ball(ledger(), surfaceVoxels(sphere, latticeAround(sphere, 12)), Voxel(), 2);
    ball.grid().shareOut(1000);
    ball.grid().voxels()[ball.grid().active().front()].setSwitchedOff(true);
    ball.step(pose, {}, dt);
    drawAlong(still, ball, 0.5f);
    const particles::ParticleStore& s = still.particles().store;
    const Lattice& lattice = ball.grid().lattice();
    int drawn = 0, inItsBox = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        const glm::ivec3 cell(glm::floor(lattice.toVoxels(pose.toLocal(s.position(i)))));
        const bool box = lattice.contains(cell), on = box && ball.grid().at(cell).isOn();
        const glm::vec3 expected = on ? 0.5f * pose.velocityAt(s.position(i)) : glm::vec3(0);
        ASSERT_LT(glm::distance(glm::vec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]), expected), 1e-5f);
        drawn += on;
        inItsBox += box;
    }
    EXPECT_GT(drawn, 100);
    EXPECT_GT(inItsBox - drawn, 100) << "in the hollow, in the corners, in the switched-off voxel";
}

TEST(Crossing, LeavesAloneWhoMovesAsTheOtherDoes) {
    ShapeSystem one = crossedBlock(movingAt({0, 0, 0}, {3, 1, 0}), 1);
    const ShapeSystem other = crossedBlock(movingAt({0.5f, 0, 0}, {3, 1, 0}), 2);
    const std::uint64_t before = one.stateHash();
    EXPECT_GT(drawAlong(one, other, 0.5f), 1000u);
    EXPECT_EQ(one.stateHash(), before);
}

TEST(Crossing, IsTheSameAtAnyNumberOfThreads) {
    const auto hashAt = [](int threads) {
        std::uint64_t hash = 0;
        tbb::task_arena(threads).execute([&] {
            ShapeSystem a = crossedBlock({}, 1);
            const ShapeSystem b = crossedBlock(movingAt({0.7f, 0.3f, 0}, {1, 2, 3}), 2);
            drawAlong(a, b, 0.3f);
            hash = a.stateHash();
        });
        return hash;
    };
    EXPECT_EQ(hashAt(3), hashAt(1));
}

}  // namespace
}  // namespace dustbench::voxel_shape
