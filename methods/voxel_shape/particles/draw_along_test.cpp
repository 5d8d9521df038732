#include "methods/voxel_shape/particles/draw_along.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/particles/particle_store.h"
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
        const std::array<float, 3> from{unit(random), unit(random), unit(random)};  // in this order with every compiler
        const glm::vec3 p = place + glm::vec3(from[0], from[1], from[2]);
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
    const auto dust = dustAbout({0, 0, 0}, 800'000, [](const glm::vec3& p) { return glm::vec3(3 * p.y, 0, 0); });
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

const std::vector<std::filesystem::path> names{"a.vti", "b.vti"};

/// Samples a field in a cube of 3 m around the origin.
template <typename Field>
volumes::VectorSeries seriesOf(const Field& field, const std::vector<double>& times) {
    std::vector<volumes::VectorGrid> grids;
    for (const double time : times) {
        volumes::VectorGrid grid{glm::ivec3(12), glm::dvec3(-1.5), 0.25, time, false, {}};
        for (int z = 0; z < 12; ++z)
            for (int y = 0; y < 12; ++y)
                for (int x = 0; x < 12; ++x)
                    grid.values.push_back(field(glm::dvec3(-1.5) + 0.25 * (glm::dvec3(x, y, z) + 0.5), time));
        grids.push_back(grid);
    }
    return {grids, names};
}

particles::ParticleStore particlesWithin(MemoryLedger& ledger, float half, unsigned seed) {
    particles::ParticleStore store(ledger);
    store.resize(3000);
    std::mt19937_64 chance(seed);
    std::uniform_real_distribution<float> place(-half, half);
    for (std::size_t i = 0; i < store.size(); ++i) {
        store.serial[i] = i;
        store.x[i] = place(chance), store.y[i] = place(chance), store.z[i] = place(chance);
        store.velocityX[i] = store.velocityY[i] = store.velocityZ[i] = 0;
    }
    return store;
}

TEST(FieldFlow, GivesTheShareOfALinearFieldExactly) {
    const auto field = [](const glm::dvec3& p, double t) { return glm::vec3(p.y + t, -2 * p.x, 1 + p.z - t); };
    const volumes::VectorSeries series = seriesOf([&](const glm::dvec3& p, double t) { return field(p, t); }, {0, 2});
    for (const unsigned seed : {1u, 2u}) {
        MemoryLedger ledger;
        particles::ParticleStore store = particlesWithin(ledger, 1.3f, seed);
        for (std::size_t i = 0; i < store.size(); ++i) store.velocityX[i] = 4;
        drawAlong(store, flowOf(series, 0.7), 0.25f);
        for (std::size_t i = 0; i < store.size(); ++i) {
            const glm::vec3 u = field(glm::dvec3(store.position(i)), 0.7);
            ASSERT_NEAR(store.velocityX[i], 0.75f * 4 + 0.25f * u.x, 1e-5f);
            ASSERT_NEAR(store.velocityY[i], 0.25f * u.y, 1e-5f);
            ASSERT_NEAR(store.velocityZ[i], 0.25f * u.z, 1e-5f);
        }
    }
}

/// Returns the maximum error of position after half a turn of a rigid rotation in `steps` steps.
double errorOfHalfATurn(int steps) {
    const double omega = 2;
    const volumes::VectorSeries series =
        seriesOf([&](const glm::dvec3& p, double) { return glm::vec3(omega * p.z, 0, -omega * p.x); }, {0});
    MemoryLedger ledger;
    particles::ParticleStore store = particlesWithin(ledger, 0.7f, 4);
    std::vector<glm::vec3> starts;
    for (std::size_t i = 0; i < store.size(); ++i) starts.push_back(store.position(i));
    const float dt = static_cast<float>(M_PI / omega / steps);
    for (int step = 0; step < steps; ++step) {
        drawAlong(store, flowOf(series, 0), 1);
        for (std::size_t i = 0; i < store.size(); ++i) {
            store.x[i] += dt * store.velocityX[i];
            store.y[i] += dt * store.velocityY[i];
            store.z[i] += dt * store.velocityZ[i];
        }
    }
    float worst = 0;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const glm::vec3 turned(-starts[i].x, starts[i].y, -starts[i].z);
        worst = std::max(worst, glm::distance(store.position(i), turned));
    }
    return static_cast<double>(worst);
}

TEST(FieldFlow, CarriesParticlesRoundInARigidRotationToFirstOrder) {
    const double coarse = errorOfHalfATurn(200), fine = errorOfHalfATurn(800);
    EXPECT_LT(coarse, 0.99 * M_PI * M_PI / 2 / 200 * 1.05) << "|x|·ωT·ω·dt/2 at the farthest, 0.99 m from the axis";
    EXPECT_NEAR(coarse / fine, 4, 0.4);
}

TEST(FieldFlow, OfAShapesFrameMovesTurnsAndGrowsWithIt) {
    const volumes::VectorSeries series =
        seriesOf([](const glm::dvec3& p, double) { return glm::vec3(1, p.x, 0); }, {0});
    Pose pose;
    pose.rotation = glm::mat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0});  // a quarter turn about y: its x is the world's -z
    pose.position = {10, 2, -5};
    pose.scale = 2;
    pose.velocity = {3, 0, 0};
    pose.angularVelocity = {0, 0.5f, 0};
    MemoryLedger ledger;
    particles::ParticleStore store = particlesWithin(ledger, 3, 4);
    for (std::size_t i = 0; i < store.size(); ++i) store.x[i] += 10, store.y[i] += 2, store.z[i] -= 5;
    drawAlong(store, flowOf(series, pose, 0), 1);
    int within = 0;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const glm::vec3 from = store.position(i) - pose.position;
        const float ownX = -from.z / 2;
        if (std::abs(ownX) > 1.37f) continue;  // in cells at the border the value is not linear
        ASSERT_NEAR(store.velocityX[i], 3 + 0.5f * from.z, 1e-4f);
        ASSERT_NEAR(store.velocityY[i], 2 * ownX, 1e-4f);
        ASSERT_NEAR(store.velocityZ[i], -2 - 0.5f * from.x, 1e-4f);
        ++within;
    }
    EXPECT_GT(within, 1000);
}

TEST(FieldFlow, LeavesAloneWhoIsBeyondItsGrid) {
    const volumes::VectorSeries series = seriesOf([](const glm::dvec3&, double) { return glm::vec3(5); }, {0});
    MemoryLedger ledger;
    particles::ParticleStore store = particlesWithin(ledger, 3, 2);
    drawAlong(store, flowOf(series, 0), 1);
    int within = 0;
    for (std::size_t i = 0; i < store.size(); ++i) {
        const glm::vec3 p = glm::abs(store.position(i));
        const bool in = std::max({p.x, p.y, p.z}) <= 1.5f;
        if (in)
            ASSERT_NEAR(store.velocityX[i], 5, 1e-5f);
        else
            ASSERT_EQ(store.velocityX[i], 0);
        within += in;
    }
    EXPECT_GT(within, 100);
}

Flow uniform(const glm::vec3& velocity) {
    return [=](const glm::vec3&) { return velocity; };
}

glm::dvec3 momentumOf(const particles::ParticleStore& s) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < s.size(); ++i) sum += glm::dvec3(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
    return sum;
}

TEST(FlowWake, TakesFromTheAirWhatTheParticlesGain) {
    for (const float loading : {0.1f, 3.0f, 50.0f}) {
        ShapeSystem shape = crossedBlock(movingAt({30, 2, -4}, {0, 1, 0}), 3);
        FlowWake wake(ledger(), loading, 1e6f);
        const glm::dvec3 before = momentumOf(shape.particles().store);
        for (int step = 0; step < 5; ++step) wake.exchange(shape, uniform({6, -2, 1}), 8, dt);
        const glm::dvec3 gained = momentumOf(shape.particles().store) - before;
        EXPECT_LT(glm::distance(wake.momentumInParticles(shape), -gained), 1e-4 * glm::length(gained)) << loading;
        EXPECT_GT(gained.x, 100);
    }
}

/// Evenly distributed particles at rest in air that moves: v tends to u/(1 + L), and u + w to the same, at the rate
/// k(1 + L). Random places leave the loading uneven, so only means are compared, within the block.
TEST(FlowWake, BringsParticlesAndAirToTheVelocityOfTheirMomentum) {
    MarkedVoxels marked(Lattice{{8, 8, 8}, glm::vec3(-1), 0.25f});
    std::ranges::fill(marked.marked, std::uint8_t{1});
    ShapeSystem shape(ledger(), marked, Voxel(), 4);
    shape.grid().shareOut(200'000);
    shape.step({}, {}, dt);
    const float loading = 2, rate = 3;
    FlowWake wake(ledger(), loading, 1e6f);
    const particles::ParticleStore& s = shape.particles().store;
    for (int step = 1; step <= 60; ++step) {
        wake.exchange(shape, uniform({3, 0, 0}), rate, dt);
        if (step % 20 != 0) continue;
        double sum = 0;
        int within = 0;
        for (std::size_t i = 0; i < s.size(); ++i) {
            const glm::vec3 p = glm::abs(s.position(i));
            if (std::max({p.x, p.y, p.z}) > 0.6f) continue;
            sum += static_cast<double>(s.velocityX[i]);
            ++within;
        }
        const double nearness =
            1 - std::exp(-static_cast<double>(rate * (1 + loading) * static_cast<float>(step) * dt));
        EXPECT_NEAR(sum / within, 3 / (1 + 2.0) * nearness, 0.02) << step;
        float ofAir = 0;
        for (int i = 0; i < 125; ++i)
            ofAir += wake.at(shape, 0.2f * (glm::vec3(i % 5, i / 5 % 5, i / 25) - 2.0f)).x / 125;
        EXPECT_NEAR(ofAir, -2 * nearness, 0.04) << step;
    }
}

TEST(FlowWake, OfWeightlessParticlesDoesNotActBack) {
    ShapeSystem shape = crossedBlock({}, 1), other = crossedBlock({}, 1);
    FlowWake wake(ledger(), 0, 1);
    wake.exchange(shape, uniform({2, 0, 0}), 4, dt);
    wake.carry(shape, uniform({2, 0, 0}), dt);
    drawAlong(other.particles().store, uniform({2, 0, 0}), 1 - std::exp(-4 * dt));
    const particles::ParticleStore &a = shape.particles().store, &b = other.particles().store;
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.velocityX[i], b.velocityX[i], 1e-6f);
    EXPECT_EQ(wake.at(shape, {0, 0, 0}), glm::vec3(0));
}

/// The wake moves with the air past a shape at rest, stays with a shape that moves with the air, and fades.
TEST(FlowWake, IsCarriedByTheAirAndFades) {
    const auto middleOf = [](const FlowWake& wake, const ShapeSystem& shape) {
        double sum = 0, moment = 0;
        for (float x = -1.1f; x < 1.1f; x += 0.02f) {
            const double w = static_cast<double>(wake.at(shape, shape.pose().position + glm::vec3(x, 0, 0)).x);
            sum += w;
            moment += w * static_cast<double>(x);
        }
        return std::pair(moment / sum, sum);
    };
    for (const bool moves : {false, true}) {
        const glm::vec3 air(0.5f, 0, 0);
        ShapeSystem shape = crossedBlock(movingAt({0, 0, 0}, moves ? air : glm::vec3(0)), 6);
        particles::ParticleStore& s = shape.particles().store;
        for (std::size_t i = 0; i < s.size(); ++i)  // one slab of fast particles
            s.velocityX[i] = std::abs(s.x[i] + 0.4f) < 0.2f ? 3.0f : air.x;
        FlowWake wake(ledger(), 0.01f, 2);
        wake.exchange(shape, uniform(air), 5, dt);
        const auto [before, was] = middleOf(wake, shape);
        for (int step = 0; step < 48; ++step) wake.carry(shape, uniform(air), 1.0f / 60);
        const auto [after, is] = middleOf(wake, shape);
        EXPECT_NEAR(after - before, moves ? 0 : 0.5 * 48 / 60, 0.06) << moves;
        EXPECT_NEAR(is / was, std::exp(-48.0 / 60 / 2), 0.1) << moves;
    }
}

TEST(FlowWake, IsTheSameAtAnyNumberOfThreads) {
    const auto hashAt = [](int threads) {
        std::uint64_t hash = 0;
        tbb::task_arena(threads).execute([&] {
            ShapeSystem shape = crossedBlock({}, 1);
            FlowWake wake(ledger(), 1, 1);
            for (int step = 0; step < 3; ++step) {
                wake.exchange(shape, uniform({2, 1, 0}), 4, dt);
                wake.carry(shape, uniform({2, 1, 0}), dt);
            }
            hash = shape.stateHash();
        });
        return hash;
    };
    EXPECT_EQ(hashAt(3), hashAt(1));
}

}  // namespace
}  // namespace dustbench::voxel_shape
