// Tests which particles voxels admit: up to their maximum density, or all, as in the paper.
#include <gtest/gtest.h>

#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/particles/test_ledger.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

constexpr std::uint32_t wanted = 5000;

Motion law(bool fullVoxelsRefuse) {
    Motion motion;
    motion.fullVoxelsRefuse = fullVoxelsRefuse;
    motion.birthSpeed = 0.1f;
    motion.fillSeconds = 0.05f;
    return motion;
}

/// Returns a sphere of particles after some seconds.
ShapeSystem sphereAfter(double seconds, const Motion& motion) {
    const scene::Mesh sphere = sphereMesh(1, 20);
    ShapeSystem system(ledger(), surfaceVoxels(sphere, latticeAround(sphere, 20)), Voxel(), 7);
    system.grid().shareOut(wanted);
    for (int step = 0; step < seconds / static_cast<double>(dt); ++step) system.step({}, motion, dt);
    return system;
}

TEST(DensityLaw, OfOursHoldsTheNumberThatWasAskedFor) {
    for (const double seconds : {2.0, 4.0, 8.0, 16.0}) {
        const ShapeCount count = sphereAfter(seconds, law(true)).count();
        EXPECT_EQ(count.room, wanted);
        EXPECT_NEAR(static_cast<double>(count.inside), wanted, 0.05 * wanted) << seconds;
        EXPECT_LE(count.inside, count.room);
    }
}

TEST(DensityLaw, OfThePaperLetsAShapeHoldMoreThanWasAskedFor) {
    std::size_t before = wanted;
    for (const double seconds : {2.0, 4.0, 8.0}) {
        const ShapeSystem system = sphereAfter(seconds, law(false));
        const ShapeCount count = system.count();
        EXPECT_GT(count.inside, before) << seconds;
        before = count.inside;
        EXPECT_EQ(count.inside + count.fading, system.particles().size());
    }
    EXPECT_GT(before, wanted + wanted / 4);
}

/// Returns the counts after some seconds of a row of five voxels whose forces push towards the middle one, where the
/// air slows particles down.
ShapeCount gatheringAfter(double seconds, Motion motion) {
    motion.airDragPerSecond = 2;
    MarkedVoxels marked(Lattice{{5, 1, 1}, glm::vec3(0), 1});
    marked.marked.assign(5, 1);
    ShapeSystem system(ledger(), marked, Voxel(), 1);
    system.grid().shareOut(500);
    for (int x = 0; x < 5; ++x)
        x == 2 ? system.grid().at({x, 0, 0}).setForce(Force::gravity, {0, 3, 0}, 0)
               : system.grid().at({x, 0, 0}).setForce(Force::linear, {x < 2 ? 2.0f : -2.0f, 0, 0}, 0);
    for (int step = 0; step < seconds / static_cast<double>(dt); ++step) system.step({}, motion, dt);
    return system.count();
}

TEST(DensityLaw, OfThePaperFillsWithoutEndAShapeWhoseForcesGatherParticles) {
    // The same number in every second, however long.
    const auto held = [](double seconds) { return static_cast<double>(gatheringAfter(seconds, law(false)).inside); };
    const double ten = held(10), twenty = held(20), forty = held(40);
    EXPECT_GT(ten, 1500);
    EXPECT_NEAR((twenty - ten) / ((forty - twenty) / 2), 1, 0.2);
    EXPECT_LE(gatheringAfter(40, law(true)).inside, 500u);
}

TEST(DensityLaw, OfThePaperLetsAParticleIntoAFullVoxelWhereItLivesAndGivesNoBirthThere) {
    MarkedVoxels marked(Lattice{{2, 1, 1}, glm::vec3(0), 1});
    marked.marked = {1, 1};
    ShapeSystem system(ledger(), marked, Voxel(), 1);
    for (Voxel& voxel : system.grid().voxels()) voxel.maximumDensity = 1;
    system.step({}, {}, dt);
    particles::ParticleStore& store = system.particles().store;
    store.x[0] = 0.95f;
    store.velocityX[0] = 6;
    Motion motion = law(false);
    motion.fillSeconds = 0;
    motion.birthSpeed = 0;
    for (int step = 0; step < 4; ++step) system.step({}, motion, dt);
    store.velocityX[0] = 0;
    for (int step = 0; step < 200; ++step) system.step({}, motion, dt);
    EXPECT_EQ(system.particles().place[0], 1u);
    EXPECT_EQ(store.age[0], 0);
    EXPECT_EQ(system.grid().voxels()[0].density, 1u) << "its vacancy was filled";
    EXPECT_EQ(system.grid().voxels()[1].density, 2u) << "the voxel that its particle entered has two";
    EXPECT_EQ(system.particles().size(), 3u);
}

TEST(DensityLaw, CountsWhoFadesApart) {
    ShapeSystem system = sphereAfter(2, law(true));
    const ShapeCount count = system.count();
    std::size_t outside = 0;
    for (const std::uint32_t place : system.particles().place) outside += place >= ShapeParticles::outside;
    EXPECT_EQ(count.fading, outside);
    EXPECT_GT(count.fading, 0u);
    EXPECT_EQ(count.inside + count.fading, system.particles().size());
    // Voxels that are off have no capacity.
    for (const std::uint32_t i : system.grid().active()) system.grid().voxels()[i].setSwitchedOff(true);
    EXPECT_EQ(system.count().room, 0u);
}

}  // namespace
}  // namespace dustbench::voxel_shape
