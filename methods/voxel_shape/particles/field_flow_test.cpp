#include "methods/voxel_shape/particles/field_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::voxel_shape {
namespace {

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
        drawAlong(store, series, 0.7, 0.25f);
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
        drawAlong(store, series, 0, 1);
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
    drawAlong(store, series, pose, 0, 1);
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
    drawAlong(store, series, 0, 1);
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

}  // namespace
}  // namespace dustbench::voxel_shape
