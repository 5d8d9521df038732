#include "methods/voxel_shape/particles/dust_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "methods/kit/particles/particle_store.h"
#include "methods/voxel_shape/particles/test_ledger.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns a block of 8³ voxels of 0.25 m.
ShapeSystem blockAt(const glm::vec3& position) {
    MarkedVoxels marked(Lattice{{8, 8, 8}, glm::vec3(-1), 0.25f});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    ShapeSystem system(ledger(), marked, Voxel(), 1);
    system.grid().shareOut(2000);
    Pose pose;
    pose.position = position;
    system.step(pose, {}, 1.0f / 60);
    return system;
}

/// Returns puffs at random places within 3 m of a point, with the velocities `velocityAt`.
template <typename Velocity>
particles::ParticleStore dustAbout(const glm::vec3& place, int count, const Velocity& velocityAt) {
    particles::ParticleStore dust(ledger());
    dust.resize(static_cast<std::size_t>(count));
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-3, 3);
    for (std::size_t i = 0; i < dust.size(); ++i) {
        dust.serial[i] = i;
        const glm::vec3 p = place + glm::vec3(unit(random), unit(random), unit(random));
        const glm::vec3 v = velocityAt(p);
        dust.x[i] = p.x, dust.y[i] = p.y, dust.z[i] = p.z;
        dust.velocityX[i] = v.x, dust.velocityY[i] = v.y, dust.velocityZ[i] = v.z;
    }
    return dust;
}

TEST(DustFlow, DrawsParticlesTowardsAUniformFlow) {
    ShapeSystem shape = blockAt({30, 1, 0});
    const auto dust = dustAbout({30, 1, 0}, 600'000, [](const glm::vec3&) { return glm::vec3(2, -1, 0.5f); });
    DustFlow(ledger()).drawAlong(shape, dust, 0.25f);
    const particles::ParticleStore& s = shape.particles().store;
    for (std::size_t i = 0; i < s.size(); ++i) {
        ASSERT_NEAR(s.velocityX[i], 0.5f, 1e-4f);
        ASSERT_NEAR(s.velocityY[i], -0.25f, 1e-4f);
        ASSERT_NEAR(s.velocityZ[i], 0.125f, 1e-4f);
    }
}

TEST(DustFlow, FollowsAShearedFlowFromPlaceToPlace) {
    ShapeSystem shape = blockAt({0, 0, 0});
    const auto dust = dustAbout({0, 0, 0}, 200'000, [](const glm::vec3& p) { return glm::vec3(3 * p.y, 0, 0); });
    DustFlow(ledger()).drawAlong(shape, dust, 1);
    const particles::ParticleStore& s = shape.particles().store;
    for (std::size_t i = 0; i < s.size(); ++i) ASSERT_NEAR(s.velocityX[i], 3 * s.y[i], 0.15f) << i;
}

TEST(DustFlow, LeavesAloneWhereThereIsNoDust) {
    ShapeSystem shape = blockAt({0, 0, 0});
    const std::uint64_t before = shape.stateHash();
    const auto dust = dustAbout({20, 0, 0}, 1000, [](const glm::vec3&) { return glm::vec3(5, 0, 0); });
    DustFlow(ledger()).drawAlong(shape, dust, 1);
    EXPECT_EQ(shape.stateHash(), before);
}

}  // namespace
}  // namespace dustbench::voxel_shape
