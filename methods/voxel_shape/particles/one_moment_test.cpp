// Tests that particles and lattice are evaluated at the same time: a moving shape holds the same particles as one at
// rest.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "methods/voxel_shape/particles/shape_system.h"
#include "methods/voxel_shape/particles/test_ledger.h"
#include "methods/voxel_shape/voxels/surface_voxels.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

using Random = std::mt19937;

int between(Random& random, int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
}

float unitOf(Random& random) {
    return std::uniform_real_distribution<float>(-1, 1)(random);
}

glm::mat3 anyRotation(Random& random) {
    return glm::mat3(
        glm::rotate(glm::mat4(1), 3 * unitOf(random), glm::normalize(glm::vec3(unitOf(random), unitOf(random), 1.1f))));
}

/// Returns one of the 24 rotations that map axes to axes.
glm::mat3 rightAngles(Random& random) {
    const glm::mat3 x(1, 0, 0, 0, 0, 1, 0, -1, 0), y(0, 0, -1, 0, 1, 0, 1, 0, 0);
    glm::mat3 rotation(1);
    for (int turns = between(random, 0, 8); turns > 0; --turns) rotation = (between(random, 0, 1) ? x : y) * rotation;
    return rotation;
}

/// Returns random voxels of a box. The edge is exact in floats; each voxel has its own look and maximum density.
VoxelGrid anyShape(Random& random) {
    const Lattice lattice{{between(random, 2, 9), between(random, 2, 9), between(random, 2, 9)},
                          glm::vec3(between(random, -4, 4), between(random, -4, 4), between(random, -4, 4)) / 4.0f,
                          std::ldexp(1.0f, -between(random, 1, 3))};
    MarkedVoxels marked(lattice);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        marked.marked[i] = between(random, 0, 2) > 0;
        marked.colours[i] = glm::abs(glm::vec3(unitOf(random), unitOf(random), unitOf(random)));
    }
    marked.marked[0] = 1;
    VoxelGrid grid(ledger(), marked, Voxel());
    for (const std::uint32_t i : grid.active()) {
        Voxel& voxel = grid.voxels()[i];
        voxel.maximumDensity = static_cast<std::uint32_t>(between(random, 0, 6));
        voxel.lifetimeSeconds = 0.1f + 0.4f * std::abs(unitOf(random));
        voxel.interpolationSeconds = 0.1f * std::abs(unitOf(random));
        voxel.fadingSizeMetres = 0.3f;
        voxel.picturesPerSecond = 10 * std::abs(unitOf(random));
        voxel.setForce(Force::linear, glm::vec3(between(random, -8, 8), between(random, -8, 8), 1) / 4.0f, 0);
    }
    return grid;
}

struct Newborn {
    glm::vec3 place, velocity;  ///< relative to the shape's
};

/// Rounds newborns to a lattice that is fine enough not to matter and coarse enough that no sum is rounded. Returns
/// their places. If `like` is given, moves them to those places instead, from which they may differ only by rounding.
std::vector<Newborn> settle(ShapeSystem& system, std::uint64_t born, const std::vector<Newborn>* like) {
    particles::ParticleStore& s = system.particles().store;
    const Pose& pose = system.pose();
    std::vector<Newborn> list;
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s.serial[i] < born) continue;
        const auto rounded = [](const glm::vec3& v, float steps) { return glm::round(v * steps) / steps; };
        const glm::vec3 place = s.position(i) - pose.position;
        const glm::vec3 velocity = glm::vec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]) - pose.velocity;
        Newborn newborn{rounded(place, 16384), rounded(velocity, 256)};
        if (like) {
            newborn = (*like)[list.size()];
            EXPECT_LT(glm::distance(newborn.place, place), 1e-4f);
            EXPECT_LT(glm::distance(newborn.velocity, velocity), 5e-3f);
        }
        list.push_back(newborn);
        const glm::vec3 to = pose.position + newborn.place, with = pose.velocity + newborn.velocity;
        s.x[i] = to.x, s.y[i] = to.y, s.z[i] = to.z;
        s.velocityX[i] = with.x, s.velocityY[i] = with.y, s.velocityZ[i] = with.z;
    }
    return list;
}

/// Compares places and velocities relative to the shape's, and everything else bit by bit.
void expectSame(const ShapeSystem& still, const ShapeSystem& moving) {
    const ShapeParticles &a = still.particles(), &b = moving.particles();
    ASSERT_EQ(a.size(), b.size());
    ASSERT_EQ(a.place, b.place);
    ASSERT_EQ(a.settlingSeconds, b.settlingSeconds);
    ASSERT_EQ(a.picture, b.picture);
    const particles::ParticleStore &s = a.store, &t = b.store;
    ASSERT_EQ(s.serial, t.serial);
    for (const auto column :
         {&particles::ParticleStore::age, &particles::ParticleStore::lifetime, &particles::ParticleStore::radius,
          &particles::ParticleStore::opacity, &particles::ParticleStore::red, &particles::ParticleStore::green,
          &particles::ParticleStore::blue})
        ASSERT_EQ(s.*column, t.*column);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(s.position(i) - still.pose().position, t.position(i) - moving.pose().position) << i;
        ASSERT_EQ(s.velocityX[i], t.velocityX[i] - moving.pose().velocity.x);
    }
}

TEST(OneMoment, MakesAShapeAtConstantSpeedTheSameAsAtRestWhereNothingIsRounded) {
    constexpr float dt = 1.0f / 64;
    std::size_t outside = 0, entered = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random random(seed), again(seed);
        ShapeSystem still(ledger(), anyShape(random), seed), moving(ledger(), anyShape(again), seed);
        Pose pose;
        pose.rotation = rightAngles(random);
        pose.scale = std::ldexp(1.0f, between(random, -1, 1));
        Pose going = pose;
        // v·dt is a multiple of 2⁻¹⁰ m.
        for (int axis = 0; axis < 3; ++axis) going.velocity[axis] = static_cast<float>(between(random, -640, 640)) / 16;
        Motion motion;
        motion.birthSpeed = 0.5f;
        motion.fillSeconds = 0.1f;
        std::uint64_t born = 0;
        for (int step = 0; step < 96; ++step) {
            going.position = going.velocity * (dt * static_cast<float>(step));
            still.step(pose, motion, dt);
            moving.step(going, motion, dt);
            ASSERT_EQ(still.particles().size(), moving.particles().size()) << "seed " << seed << " step " << step;
            const std::vector<Newborn> newborn = settle(still, born, nullptr);
            settle(moving, born, &newborn);
            for (const std::uint64_t serial : still.particles().store.serial) born = std::max(born, serial + 1);
            expectSame(still, moving);
            if (HasFatalFailure()) FAIL() << "seed " << seed << " step " << step;
            for (const std::uint32_t place : still.particles().place) outside += place >= ShapeParticles::outside;
            for (const float left : still.particles().settlingSeconds) entered += left > 0;
        }
    }
    EXPECT_GT(outside, 10'000u) << "some of them fade";
    EXPECT_GT(entered, 1000u) << "some change their voxel";
}

/// Returns the maximum distance between two empirical distributions.
double kolmogorovSmirnov(std::vector<float> a, std::vector<float> b) {
    std::ranges::sort(a);
    std::ranges::sort(b);
    double distance = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const float value = std::min(a[i], b[j]);
        while (i < a.size() && a[i] <= value) ++i;
        while (j < b.size() && b[j] <= value) ++j;
        distance = std::max(distance, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                               static_cast<double>(j) / static_cast<double>(b.size())));
    }
    return distance;
}

TEST(OneMoment, MakesAShapeAtAnyConstantSpeedLookAsAtRest) {
    const scene::Mesh ball = sphereMesh(1, 20);
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        const int resolution = between(random, 12, 40);
        const auto made = [&] {
            ShapeSystem system(ledger(), surfaceVoxels(ball, latticeAround(ball, resolution)), Voxel(), seed);
            system.grid().shareOut(40'000);
            for (const std::uint32_t i : system.grid().active()) system.grid().voxels()[i].lifetimeSeconds = 0.4f;
            return system;
        };
        ShapeSystem still = made(), moving = made();
        Pose pose;
        pose.rotation = anyRotation(random);
        pose.scale = 1 + 0.5f * unitOf(random);
        Pose going = pose;
        going.velocity = 40.0f / 1.8f * glm::vec3(unitOf(random), unitOf(random), unitOf(random));
        Motion motion;
        motion.birthSpeed = 0.05f;
        motion.fillSeconds = 0.05f;
        for (int step = 0; step < 120; ++step) {
            going.position = going.velocity * (dt * static_cast<float>(step));
            still.step(pose, motion, dt);
            moving.step(going, motion, dt);
        }
        const auto count = [](const ShapeSystem& system) { return static_cast<double>(system.particles().size()); };
        EXPECT_NEAR(count(moving) / count(still), 1, 0.005) << glm::length(going.velocity) << " m/s";
        // Two samples of the same distribution exceed this limit with probability 10⁻⁶.
        const double limit = 2.69 * std::sqrt(1 / count(still) + 1 / count(moving));
        for (int axis = 0; axis < 3; ++axis) {
            const auto along = [axis](const ShapeSystem& system) {
                std::vector<float> list;
                for (std::size_t i = 0; i < system.particles().size(); ++i)
                    list.push_back(system.pose().toLocal(system.particles().store.position(i))[axis]);
                return list;
            };
            EXPECT_LT(kolmogorovSmirnov(along(still), along(moving)), limit) << "seed " << seed << " axis " << axis;
        }
    }
}

/// Returns whether a particle lies in an active voxel, computed independently in double precision.
bool liesInShape(const ShapeSystem& system, std::size_t i) {
    const Pose& pose = system.pose();
    const Lattice& lattice = system.grid().lattice();
    const glm::dvec3 local = glm::transpose(glm::dmat3(pose.rotation)) *
                             (glm::dvec3(system.particles().store.position(i)) - glm::dvec3(pose.position)) /
                             static_cast<double>(pose.scale);
    const glm::ivec3 cell(glm::floor((local - glm::dvec3(lattice.origin)) / static_cast<double>(lattice.edgeMetres)));
    return lattice.contains(cell) && system.grid().at(cell).isActive();
}

TEST(OneMoment, LeavesBehindExactlyWhatLiesOutsideWhereAShapeJumps) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const scene::Mesh ball = sphereMesh(1, 20);
        ShapeSystem system(ledger(), surfaceVoxels(ball, latticeAround(ball, 16)), Voxel(), seed);
        system.grid().shareOut(5000);
        Motion still;
        for (int step = 0; step < 3; ++step) system.step({}, still, dt);
        ASSERT_EQ(system.particles().size(), 5000u);
        // Unlimited capacity: only places decide.
        for (Voxel& voxel : system.grid().voxels()) voxel.maximumDensity = 1'000'000;
        still.fillSeconds = 1e9f;
        Pose there;
        there.position = glm::vec3(unitOf(random), unitOf(random), unitOf(random));
        there.rotation = anyRotation(random);
        there.scale = 1 + 0.5f * unitOf(random);
        system.step(there, still, dt);
        std::vector<bool> expected;
        for (std::size_t i = 0; i < 5000; ++i) expected.push_back(liesInShape(system, i));
        system.step(there, still, dt);
        const auto left = std::ranges::count(expected, false);
        EXPECT_GT(left, 1000);
        EXPECT_LT(left, 5000);
        int wrong = 0;  // a particle within rounding error of a face may be on either side
        for (std::size_t i = 0; i < 5000; ++i)
            wrong += expected[i] == (system.particles().place[i] >= ShapeParticles::outside);
        EXPECT_LE(wrong, 1) << "seed " << seed;
    }
}

TEST(OneMoment, LetsParticlesKeepTheirMomentumWhereAShapeAcceleratesTurnsOrGrows) {
    // Particles born at local r start from x(0) = r with v = velocityAt(r) and move straight; the shape moves by its
    // own law.
    const scene::Mesh ball = sphereMesh(1, 20);
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        const glm::vec3 start(3 * unitOf(random), 3 * unitOf(random), 0), speed(10 * unitOf(random), 2, 1);
        const glm::vec3 acceleration(5 * unitOf(random), unitOf(random), 0), axis(0, 1, 0);
        const float spin = 1.5f * unitOf(random), growth = 0.5f * unitOf(random);
        const auto poseAt = [&](float t) {
            Pose pose;
            pose.position = start + t * speed + 0.5f * t * t * acceleration;
            pose.velocity = speed + t * acceleration;
            pose.rotation = glm::mat3(glm::rotate(glm::mat4(1), spin * t, axis));
            pose.angularVelocity = spin * axis;
            pose.scale = std::exp(growth * t);
            pose.growth = growth;
            return pose;
        };
        ShapeSystem system(ledger(), surfaceVoxels(ball, latticeAround(ball, 16)), Voxel(), seed);
        system.grid().shareOut(2000);
        for (Voxel& voxel : system.grid().voxels()) voxel.lifetimeSeconds = 100;
        system.step(poseAt(0), {}, dt);
        Motion none;
        none.fillSeconds = 1e9f;
        std::vector<glm::vec3> r;
        for (std::size_t i = 0; i < 2000; ++i) r.push_back(system.pose().toLocal(system.particles().store.position(i)));
        for (int step = 1; step <= 60; ++step) system.step(poseAt(dt * static_cast<float>(step)), none, dt);
        const float t = 1;
        for (std::size_t i = 0; i < 2000; ++i) {
            // Lag in the shape's frame: R⁻¹ (r + t·(ω × r + g·r) − ½·t²·a) / s − r
            const glm::vec3 straight =
                r[i] + t * (spin * glm::cross(axis, r[i]) + growth * r[i]) - 0.5f * t * t * acceleration;
            const glm::vec3 expected = glm::transpose(system.pose().rotation) * straight / system.pose().scale - r[i];
            const glm::vec3 lag = system.pose().toLocal(system.particles().store.position(i)) - r[i];
            ASSERT_LT(glm::distance(lag, expected), 2e-4f);
        }
    }
}

/// Returns the position of a particle after one second in a shape that accelerates and turns, with an orbit in its only
/// voxel.
glm::vec3 afterASecond(int stepsASecond) {
    const float dt = 1.0f / static_cast<float>(stepsASecond);
    MarkedVoxels marked(Lattice{{1, 1, 1}, glm::vec3(-1), 2});
    marked.marked[0] = 1;
    Voxel pattern;
    pattern.setForce(Force::orbit, {0, 3, 0}, 0);
    ShapeSystem system(ledger(), marked, pattern, 1);
    system.grid().voxels()[0].maximumDensity = 1;
    const auto poseAt = [](float t) {
        Pose pose;
        pose.position = {10 * t + t * t, 0, 0};
        pose.velocity = {10 + 2 * t, 0, 0};
        pose.rotation = glm::mat3(glm::rotate(glm::mat4(1), t, {0, 1, 0}));
        pose.angularVelocity = {0, 1, 0};
        return pose;
    };
    system.step(poseAt(0), {}, dt);
    particles::ParticleStore& s = system.particles().store;
    s.x[0] = 0.4f, s.y[0] = 0, s.z[0] = 0;
    s.velocityX[0] = 10, s.velocityY[0] = 0, s.velocityZ[0] = 1;
    Motion none;
    none.fillSeconds = 1e9f;
    for (int step = 1; step <= stepsASecond; ++step) system.step(poseAt(dt * static_cast<float>(step)), none, dt);
    EXPECT_EQ(system.particles().place[0], 0u) << "it stays in its voxel";
    return s.position(0);
}

TEST(OneMoment, AgreesToFirstOrderWhetherAStepIsTakenAtOnceOrInFour) {
    const glm::vec3 limit = afterASecond(7680);
    const float one = glm::distance(afterASecond(60), limit), four = glm::distance(afterASecond(240), limit),
                sixteen = glm::distance(afterASecond(960), limit);
    EXPECT_LT(one, 0.15f);
    EXPECT_NEAR(one / four, 4, 0.8f);
    EXPECT_NEAR(four / sixteen, 4, 0.8f);
}

TEST(OneMoment, OfAMovingShapeIsTheSameAtAnyNumberOfThreads) {
    const auto hashAt = [](int threads) {
        std::uint64_t hash = 0;
        tbb::task_arena(threads).execute([&] {
            Random random(3);
            const scene::Mesh ball = sphereMesh(1, 20);
            ShapeSystem system(ledger(), surfaceVoxels(ball, latticeAround(ball, 30)), Voxel(), 3);
            system.grid().shareOut(20'000);
            Motion motion;
            motion.birthSpeed = 0.5f;
            for (int step = 0; step < 30; ++step) {
                Pose pose;
                pose.rotation = anyRotation(random);
                pose.position = 0.1f * glm::vec3(unitOf(random), unitOf(random), unitOf(random));
                pose.scale = 1 + 0.1f * unitOf(random);
                system.step(pose, motion, 1.0f / 60);
            }
            hash = system.stateHash();
        });
        return hash;
    };
    const std::uint64_t one = hashAt(1);
    for (const int threads : {2, 3, 7}) EXPECT_EQ(hashAt(threads), one) << threads;
}

}  // namespace
}  // namespace dustbench::voxel_shape
