#include "methods/voxel_shape/particles/shape_system.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <set>

#include "methods/voxel_shape/particles/test_ledger.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

/// Returns a row of active voxels of 1 m along x, starting at (0, 0, 0).
MarkedVoxels rowOfVoxels(int count) {
    MarkedVoxels marked(Lattice{{count, 1, 1}, glm::vec3(0), 1});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    std::ranges::fill(marked.colours, glm::vec3(1, 0, 0));
    return marked;
}

Voxel pattern() {
    Voxel voxel;
    voxel.colour = PackedColour({0, 0, 0, 0.5f});
    voxel.fadingColour = PackedColour({0, 0, 1, 0});
    voxel.sizeMetres = 0.1f;
    voxel.fadingSizeMetres = 0.5f;
    voxel.lifetimeSeconds = 0.5f;
    return voxel;
}

ShapeSystem sphereSystem(std::uint32_t particles, int resolution = 20) {
    const scene::Mesh sphere = sphereMesh(1, 20);
    ShapeSystem system(ledger(), surfaceVoxels(sphere, latticeAround(sphere, resolution)), pattern(), 7);
    system.grid().shareOut(particles);
    return system;
}

/// Births are so rare that a single particle stays alone.
Motion withoutBirths() {
    Motion motion;
    motion.fillSeconds = 1e9f;
    return motion;
}

/// Returns one particle in the middle of the first of several voxels with a capacity of one each.
ShapeSystem oneParticle(int voxels, const glm::vec3& velocity) {
    ShapeSystem system(ledger(), rowOfVoxels(voxels), pattern(), 1);
    system.grid().voxels()[0].maximumDensity = 1;
    system.step({}, {}, dt);
    for (Voxel& voxel : system.grid().voxels()) voxel.maximumDensity = 1;
    particles::ParticleStore& store = system.particles().store;
    EXPECT_EQ(store.size(), 1u);
    store.x[0] = store.y[0] = store.z[0] = 0.5f;
    store.velocityX[0] = velocity.x;
    store.velocityY[0] = velocity.y;
    store.velocityZ[0] = velocity.z;
    return system;
}

/// Compares the voxels' densities with a count of the particles.
void expectDensitiesAreCounts(const ShapeSystem& system) {
    std::map<std::uint32_t, std::uint32_t> counts;
    for (const std::uint32_t place : system.particles().place)
        if ((place & ShapeParticles::outside) == 0) ++counts[place];
    for (std::uint32_t i = 0; i < system.grid().voxels().size(); ++i)
        ASSERT_EQ(system.grid().voxels()[i].density, counts.contains(i) ? counts[i] : 0u) << i;
}

TEST(ShapeSystem, GivesBirthInActiveVoxelsAloneAndNeverHasMoreInOneThanItsMaximum) {
    ShapeSystem system = sphereSystem(5000);
    // A third of the voxels is off at first.
    for (std::size_t k = 0; k < system.grid().active().size(); k += 3)
        system.grid().voxels()[system.grid().active()[k]].setSwitchedOff(true);
    Motion motion;
    motion.birthSpeed = 0.6f;
    motion.fillSeconds = 0.2f;
    Pose pose;
    pose.rotation = glm::mat3(glm::rotate(glm::mat4(1), 0.7f, glm::normalize(glm::vec3(1, 2, 3))));
    pose.position = {4, 5, 6};
    pose.scale = 2;
    std::uint64_t born = 0;
    for (int step = 0; step < 120; ++step) {
        std::map<std::uint32_t, std::uint32_t> newborn;
        system.step(pose, motion, dt);
        const ShapeParticles& p = system.particles();
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (p.store.serial[i] < born) continue;
            ++newborn[p.place[i]];
            const glm::vec3 place = system.grid().lattice().toVoxels(pose.toLocal(p.store.position(i)));
            const glm::ivec3 cell(glm::floor(place));
            const glm::vec3 off = glm::abs(place - (glm::vec3(system.grid().lattice().cell(p.place[i])) + 0.5f));
            ASSERT_LE(std::max({off.x, off.y, off.z}), 0.5f + 1e-4f) << cell.x << " " << cell.y << " " << cell.z;
        }
        for (const auto& [index, count] : newborn) ASSERT_TRUE(system.grid().voxels()[index].isOn());
        for (const std::uint32_t index : system.grid().active())
            ASSERT_LE(system.grid().voxels()[index].density, system.grid().voxels()[index].maximumDensity);
        for (const std::uint64_t serial : p.store.serial) born = std::max(born, serial + 1);
    }
    EXPECT_GT(born, 5000u) << "some have left and been replaced";
    expectDensitiesAreCounts(system);
}

TEST(ShapeSystem, FillsEveryVoxelToItsMaximumAndKeepsItThereWhereNothingMoves) {
    ShapeSystem system = sphereSystem(5000);
    for (int step = 0; step < 10; ++step) system.step({}, {}, dt);
    EXPECT_EQ(system.particles().size(), 5000u);
    for (const std::uint32_t i : system.grid().active())
        ASSERT_EQ(system.grid().voxels()[i].density, system.grid().voxels()[i].maximumDensity);
    // Particles inside do not age: after their lifetime they are still the first ones.
    for (int step = 0; step < 120; ++step) system.step({}, {}, dt);
    EXPECT_EQ(*std::ranges::max_element(system.particles().store.serial), 4999u);
    EXPECT_EQ(*std::ranges::max_element(system.particles().store.age), 0.0f);
}

TEST(ShapeSystem, LetsAParticleThatLeavesFadeByItsLastVoxelAndDie) {
    ShapeSystem system = oneParticle(1, {0, 3, 0});
    for (int step = 0; step < 10; ++step) system.step({}, withoutBirths(), dt);  // 0.5 m: exactly at the face
    const particles::ParticleStore& store = system.particles().store;
    ASSERT_NEAR(store.opacity[0], 0.5f, 1e-5f);
    int outside = -1;  // in the step in which it leaves, it still has its old look
    float opacityBefore = store.opacity[0];
    while (store.size() == 1 && outside < 100) {
        system.step({}, withoutBirths(), dt);
        if (store.empty() || (system.particles().place[0] & ShapeParticles::outside) == 0) continue;
        if (++outside == 0) continue;
        const float share = static_cast<float>(outside) * dt / 0.5f;
        ASSERT_NEAR(store.opacity[0], 0.5f * (1 - share), 1e-4f);
        ASSERT_NEAR(store.blue[0], share, 1e-4f);
        ASSERT_NEAR(store.radius[0], 0.1f + share * 0.4f, 1e-4f);
        ASSERT_LT(store.opacity[0], opacityBefore);
        opacityBefore = store.opacity[0];
    }
    EXPECT_EQ(store.size(), 0u);
    EXPECT_NEAR(outside, 29, 1) << "half a second";
    EXPECT_EQ(system.grid().voxels()[0].density, 0u);
}

TEST(ShapeSystem, LetsAParticleThatReturnsLiveOn) {
    ShapeSystem system = oneParticle(1, {0, 3, 0});
    const particles::ParticleStore& store = system.particles().store;
    while ((system.particles().place[0] & ShapeParticles::outside) == 0) system.step({}, withoutBirths(), dt);
    for (int step = 0; step < 12; ++step) system.step({}, withoutBirths(), dt);
    EXPECT_GT(store.age[0], 0.15f);
    EXPECT_LT(store.opacity[0], 0.4f);
    system.particles().store.velocityY[0] = -3;
    system.grid().voxels()[0].interpolationSeconds = 0.1f;
    for (int step = 0; step < 24; ++step) system.step({}, withoutBirths(), dt);
    ASSERT_EQ(store.size(), 1u);
    EXPECT_EQ(store.age[0], 0.0f);
    EXPECT_NEAR(store.opacity[0], 0.5f, 1e-5f);
    EXPECT_EQ(system.grid().voxels()[0].density, 1u);
}

TEST(ShapeSystem, PutsAParticleOutOfAVoxelThatIsSwitchedOffAndLetsItInOnceItIsOn) {
    ShapeSystem system = oneParticle(1, {0, 0, 0});
    Voxel& voxel = system.grid().voxels()[0];
    voxel.setSwitchedOff(true);
    for (int step = 0; step < 3; ++step) {
        system.step({}, withoutBirths(), dt);
        EXPECT_EQ(system.particles().place[0], ShapeParticles::outside);
        EXPECT_EQ(voxel.density, 0u);
    }
    EXPECT_NEAR(system.particles().store.age[0], 2 * dt, 1e-6f) << "it ages from the moment that it is outside";
    voxel.setSwitchedOff(false);
    system.step({}, withoutBirths(), dt);
    EXPECT_EQ(system.particles().place[0], 0u);
    EXPECT_EQ(system.particles().store.age[0], 0.0f);
    EXPECT_EQ(voxel.density, 1u);
}

TEST(ShapeSystem, LetsNobodyIntoAFullVoxelUntilThereIsRoom) {
    ShapeSystem system(ledger(), rowOfVoxels(2), pattern(), 1);
    for (Voxel& voxel : system.grid().voxels()) voxel.maximumDensity = 1;
    system.step({}, {}, dt);
    particles::ParticleStore& store = system.particles().store;
    ASSERT_EQ(store.size(), 2u);
    store.x[0] = 0.9f;
    store.velocityX[0] = 1.2f;
    int steps = 0;
    while ((system.particles().place[0] & ShapeParticles::outside) == 0) {
        system.step({}, withoutBirths(), dt);
        ASSERT_LT(++steps, 20);
    }
    store.velocityX[0] = 0;
    const glm::vec3 opaque = store.position(0);
    for (int step = 0; step < 9; ++step) system.step({}, withoutBirths(), dt);
    EXPECT_GT(store.x[0], 1.0f);
    EXPECT_EQ(store.position(0), opaque);
    EXPECT_EQ(system.grid().voxels()[1].density, 1u);
    EXPECT_NEAR(store.opacity[0], 0.5f * (1 - 9 * dt / 0.5f), 1e-4f) << "it fades while it waits";
    // The other particle leaves upwards.
    store.y[1] = 5;
    for (int step = 0; step < 3; ++step) system.step({}, withoutBirths(), dt);
    EXPECT_EQ(system.particles().place[0], 1u);
    EXPECT_EQ(store.age[0], 0.0f);
    EXPECT_EQ(system.grid().voxels()[0].density, 0u);
    EXPECT_EQ(system.grid().voxels()[1].density, 1u);
}

TEST(ShapeSystem, BringsAParticleToItsVoxelsLooksLinearlyOverItsTimeOrAtOnce) {
    for (const float seconds : {0.0f, 0.25f}) {
        ShapeSystem system = oneParticle(2, {0.6f, 0, 0});
        Voxel& second = system.grid().voxels()[1];
        second.colour = PackedColour({0, 1, 0, 1});
        second.sizeMetres = 0.3f;
        second.picturesPerSecond = 10;
        second.interpolationSeconds = seconds;
        int inside = -1;
        for (int step = 0; step < 90; ++step) {
            system.step({}, withoutBirths(), dt);
            if (system.particles().place[0] != 1 || ++inside == 0) continue;  // 0: it has just entered
            const float share = seconds > 0 ? std::min(static_cast<float>(inside) * dt / seconds, 1.0f) : 1.0f;
            const particles::ParticleStore& store = system.particles().store;
            ASSERT_NEAR(store.green[0], share, 1e-4f);
            ASSERT_NEAR(store.red[0], 1 - share, 1e-4f);
            ASSERT_NEAR(store.opacity[0], 0.5f + 0.5f * share, 1e-4f);
            ASSERT_NEAR(store.radius[0], 0.1f + 0.2f * share, 1e-4f);
            ASSERT_NEAR(system.particles().pictureSpeed[0], 10 * share, 2e-3f);
        }
        EXPECT_GT(inside, 30);
    }
}

TEST(Forces, KeepAnOrbitWithinHalfAStepsTurnOfItsRadius) {
    // |r/r₀ − 1| ≤ ω·dt for a circle by v += −ω²·r·dt, x += v·dt, which conserves energy.
    for (const float rate : {1.0f, 3.0f, 6.0f}) {
        ShapeSystem system = oneParticle(1, {0, 0, 0});
        system.grid().voxels()[0].setForce(Force::orbit, {0, rate, 0}, 0);
        const float radius = 0.35f;
        system.particles().store.x[0] = 0.5f + radius;
        system.particles().store.velocityZ[0] = rate * radius;
        double turned = 0;
        for (int step = 0; step < 3000; ++step) {
            const glm::vec3 before = system.particles().store.position(0) - 0.5f;
            system.step({}, withoutBirths(), dt);
            const glm::vec3 now = system.particles().store.position(0) - 0.5f;
            ASSERT_NEAR(glm::length(now) / radius, 1, rate * dt) << step;
            turned +=
                std::atan2(static_cast<double>(glm::cross(before, now).y), static_cast<double>(glm::dot(before, now)));
        }
        EXPECT_NEAR(std::abs(turned), static_cast<double>(rate) * 50, 0.01 * static_cast<double>(rate) * 50 + 0.1);
    }
}

TEST(Forces, GravitySwingsAParticleThroughTheMiddleAndBack) {
    ShapeSystem system = oneParticle(1, {0, 0, 0});
    system.grid().voxels()[0].setForce(Force::gravity, {0, 4, 0}, 0);
    const particles::ParticleStore& store = system.particles().store;
    system.particles().store.x[0] = 0.9f;
    for (int step = 1; step <= 300; ++step) {
        system.step({}, withoutBirths(), dt);
        // x = A·cos(ωt); the scheme's phase is accurate to (ω·dt)².
        ASSERT_NEAR(store.x[0] - 0.5f, 0.4f * std::cos(4 * dt * (static_cast<float>(step) + 0.5f)), 0.004f) << step;
        ASSERT_EQ(store.y[0], 0.5f);
    }
}

TEST(Forces, LinearIsAnAccelerationAndAHelixGoesRoundAndOn) {
    ShapeSystem linear = oneParticle(40, {0, 0, 0});
    for (Voxel& voxel : linear.grid().voxels()) voxel.setForce(Force::linear, {2, 0, 0}, 0);
    for (int step = 0; step < 60; ++step) linear.step({}, withoutBirths(), dt);
    EXPECT_NEAR(linear.particles().store.velocityX[0], 2, 1e-4f);
    EXPECT_NEAR(linear.particles().store.x[0], 1.5f, 0.02f);

    ShapeSystem helix = oneParticle(40, {0, 0, 0});
    const float rate = 3, metresARadian = 0.2f, radius = 0.3f;
    for (Voxel& voxel : helix.grid().voxels()) voxel.setForce(Force::helix, {rate, 0, 0}, metresARadian);
    helix.particles().store.y[0] = 0.5f + radius;
    helix.particles().store.velocityX[0] = rate * metresARadian;
    helix.particles().store.velocityZ[0] = rate * radius;
    double turned = 0;
    for (int step = 0; step < 300; ++step) {
        const glm::vec3 before = helix.particles().store.position(0) - 0.5f;
        helix.step({}, withoutBirths(), dt);
        const glm::vec3 now = helix.particles().store.position(0) - 0.5f;
        ASSERT_NEAR(std::hypot(now.y, now.z), radius, rate * dt * radius);
        turned += std::atan2(static_cast<double>(before.y * now.z - before.z * now.y),
                             static_cast<double>(before.y * now.y + before.z * now.z));
    }
    EXPECT_NEAR(turned, 5.0 * static_cast<double>(rate), 0.05);
    EXPECT_NEAR(helix.particles().store.x[0], 0.5f + 5 * rate * metresARadian, 0.05f);
}

TEST(Forces, ASpiralWindsOutwardsByItsFactorARadian) {
    ShapeSystem system = oneParticle(1, {0, 0, 0});
    const float rate = 2, growth = 0.05f;
    system.grid().voxels()[0].setForce(Force::spiral, {0, rate, 0}, growth);
    Motion motion = withoutBirths();
    motion.responsePerSecond = 30;
    particles::ParticleStore& store = system.particles().store;
    store.x[0] = 0.6f;
    store.velocityZ[0] = -rate * 0.1f;
    const float dtFine = dt / 8;
    float angle = 0;
    const float start = 0.1f;
    for (int step = 0; step < 8 * 60 * 5; ++step) {
        const glm::vec3 before = store.position(0) - 0.5f;
        system.step({}, motion, dtFine);
        const glm::vec3 now = store.position(0) - 0.5f;
        angle += std::abs(std::atan2(before.x * now.z - before.z * now.x, before.x * now.x + before.z * now.z));
    }
    EXPECT_NEAR(angle, 5 * rate, 0.3f);
    const float radius = glm::length(store.position(0) - 0.5f);
    EXPECT_NEAR(std::log(radius / start) / angle, growth, 0.02f);
}

TEST(Motion, OfTheShapeIsGivenToNewbornsAndLeavesTheOthersAlone) {
    ShapeSystem system = sphereSystem(2000);
    system.step({}, {}, dt);
    const std::vector<float> before(system.particles().store.velocityX.begin(),
                                    system.particles().store.velocityX.end());
    Pose pose;
    pose.velocity = {5, 0, 0};
    pose.angularVelocity = {0, 2, 0};
    pose.growth = 0.5f;
    // Particles that the shape leaves behind notice it one step later.
    for (int step = 1; step <= 2; ++step) {
        pose.position = pose.velocity * (static_cast<float>(step) * dt);
        system.step(pose, {}, dt);
    }
    const particles::ParticleStore& store = system.particles().store;
    std::size_t old = 0, newborn = 0;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const glm::vec3 velocity(store.velocityX[i], store.velocityY[i], store.velocityZ[i]);
        if (store.serial[i] < 2000) {
            ++old;
            ASSERT_EQ(velocity, glm::vec3(0));
        } else {
            ++newborn;
            const glm::vec3 expected = glm::vec3(5, 0, 0) +
                                       glm::cross(glm::vec3(0, 2, 0), store.position(i) - pose.position) +
                                       0.5f * (store.position(i) - pose.position);
            ASSERT_LT(glm::distance(velocity, expected), 1e-4f);
        }
    }
    EXPECT_GT(old, 1500u);
    EXPECT_GT(newborn, 100u);
}

TEST(Motion, WindAndGravityMoveEveryParticle) {
    ShapeSystem system = oneParticle(1, {0, 0, 0});
    Motion motion = withoutBirths();
    motion.gravity = {0, -9.81f, 0};
    for (int step = 0; step < 6; ++step) system.step({}, motion, dt);
    EXPECT_NEAR(system.particles().store.velocityY[0], -9.81f / 10, 1e-4f);
    motion.gravity = {};
    motion.wind = {1, 0, 0};
    motion.airDragPerSecond = 5;
    for (int step = 0; step < 6; ++step) system.step({}, motion, dt);
    EXPECT_NEAR(system.particles().store.velocityX[0], 1 - std::exp(-0.5f), 1e-4f);
}

TEST(ShapeSystem, IsTheSameAtAnyNumberOfThreads) {
    const auto hashAt = [](int threads) {
        tbb::task_arena arena(threads);
        std::uint64_t hash = 0;
        arena.execute([&] {
            ShapeSystem system = sphereSystem(20'000, 40);
            for (Voxel& voxel : system.grid().voxels()) voxel.setForce(Force::helix, {0, 4, 0}, 0.1f);
            Motion motion;
            motion.birthSpeed = 0.5f;
            motion.fillSeconds = 0.1f;
            for (int step = 0; step < 40; ++step) {
                Pose pose;
                pose.velocity = {3, 0, 0};
                pose.position = pose.velocity * (dt * static_cast<float>(step));
                system.step(pose, motion, dt);
            }
            hash = system.stateHash();
        });
        return hash;
    };
    const std::uint64_t one = hashAt(1);
    EXPECT_EQ(hashAt(2), one);
    EXPECT_EQ(hashAt(7), one);
}

}  // namespace
}  // namespace dustbench::voxel_shape
