#include "methods/kit/octree/narrow_keys.h"
#include "methods/kit/particles/particle_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace dustbench::octree {
namespace {

/// Coordinates in and around a world of 32 m, on cell boundaries, and outside any world.
float coordinate(std::mt19937_64& random, const Lattice& lattice) {
    const auto edge = static_cast<float>(lattice.edgeMetres), cell = edge / static_cast<float>(lattice.cellsPerEdge());
    std::uniform_real_distribution<float> around(-0.1f, 1.1f);
    const float metres = static_cast<float>(lattice.origin.x) + edge * around(random);
    switch (random() % 16) {
        case 0:
            return std::round(metres / cell) * cell;
        case 1:
            return std::nextafter(std::round(metres / cell) * cell, random() % 2 == 0 ? -1e30f : 1e30f);
        case 2:
            return metres * (random() % 2 == 0 ? 1e9f : 1e30f);
        case 3:
            return std::numeric_limits<float>::quiet_NaN();
        case 4:
            return random() % 2 == 0 ? INFINITY : -INFINITY;
        default:
            return metres;
    }
}

template <LevelRule rule>
void expectSameAsOneByOne(std::mt19937_64& random) {
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    OctreeSettings settings;
    settings.levelRule = rule;
    for (int set = 0; set < 300; ++set) {
        Lattice lattice;
        lattice.edgeMetres = 32;
        lattice.depth = settings.depth = 4 + set % 5;
        settings.levels = 1 + static_cast<int>(random() % static_cast<std::uint64_t>(settings.depth));
        lattice.origin = glm::dvec3(static_cast<double>(random() % 5) * 16 - 48);
        const std::size_t count = 1 + random() % 200;
        store.resize(count);
        std::uniform_real_distribution<float> unit(0, 1);
        for (std::size_t i = 0; i < count; ++i) {
            store.x[i] = coordinate(random, lattice);
            store.y[i] = coordinate(random, lattice);
            store.z[i] = coordinate(random, lattice);
            store.lifetime[i] = 1 + 3 * unit(random);
            store.age[i] = random() % 8 == 0 ? store.lifetime[i] : 1.2f * store.lifetime[i] * unit(random);
            store.radius[i] = 3 * unit(random);
        }
        const CellKernel<rule> kernel(store, lattice, settings);
        const std::uint32_t bricks = 1u << 3 * (lattice.depth - brickRise);
        const std::size_t first = random() % count;
        std::vector<std::uint32_t> keys(count - first + 1, 77);
        makeNarrowKeys(kernel, first, count - first, bricks, keys.data());
        for (std::size_t i = first; i < count; ++i) {
            const std::uint32_t key = keys[i - first], expected = narrowKey(kernel, i, bricks);
            ASSERT_EQ(narrowBin(key), narrowBin(expected)) << "set " << set << " particle " << i;
            if (narrowBin(key) < bricks) {
                ASSERT_EQ(narrowPlace(key), narrowPlace(expected)) << "set " << set << " particle " << i;
            }
        }
        ASSERT_EQ(keys.back(), 77u);
    }
}

TEST(NarrowKeys, AreTheSameManyAtOnceAsOneByOne) {
    std::mt19937_64 random(16);
    expectSameAsOneByOne<LevelRule::age>(random);
    expectSameAsOneByOne<LevelRule::radius>(random);
}

TEST(NarrowKeys, NameBinAndPlace) {
    MemoryLedger ledger;
    particles::ParticleStore store(ledger);
    Lattice lattice;
    lattice.edgeMetres = 256;  // cells of 1 m
    store.resize(17);
    for (std::size_t i = 0; i < store.size(); ++i) {
        store.x[i] = 16.5f;
        store.y[i] = 0.5f;
        store.z[i] = 33.5f;
        store.lifetime[i] = 4;
        store.age[i] = 0;
    }
    store.age[1] = 1.5f;
    store.age[2] = 4;
    store.x[3] = -0.5f;
    OctreeSettings settings;
    settings.levels = 8;
    const CellKernel<LevelRule::age> kernel(store, lattice, settings);
    std::vector<std::uint32_t> keys(store.size());
    makeNarrowKeys(kernel, 0, store.size(), 4096, keys.data());
    // Brick (1, 0, 2); the finest cell (0, 0, 1) within it; 3 levels up, its first octant.
    EXPECT_EQ(narrowBin(keys[0]), 0b001'100u);
    EXPECT_EQ(narrowPlace(keys[0]), placeInBrick(1, 0));
    EXPECT_EQ(narrowBin(keys[1]), 0b001'100u);
    EXPECT_EQ(narrowPlace(keys[1]), placeInBrick(0, 3));
    EXPECT_EQ(narrowBin(keys[2]), 4096u);
    EXPECT_EQ(narrowBin(keys[3]), 4097u);
    EXPECT_EQ(keys[16], keys[0]);
}

}  // namespace
}  // namespace dustbench::octree
