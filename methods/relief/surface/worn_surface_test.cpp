#include "methods/relief/surface/worn_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace dustbench::relief {
namespace {

scene::Relief randomDepths(int columns, int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> depth(0, 1);
    scene::Relief relief{columns, rows, {}, {}};
    for (int i = 0; i < columns * rows; ++i) relief.depth.push_back(depth(random));
    return relief;
}

std::vector<Impact> randomImpacts(int count, int columns, int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<Impact> impacts;
    impacts.reserve(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n)
        impacts.push_back({share(random) * static_cast<float>(columns) - 0.5f,
                           share(random) * static_cast<float>(rows) - 0.5f, n % 3 == 0 ? 0.0f : 4 * share(random),
                           static_cast<std::uint32_t>(share(random) * share(random) * DepthMap::bottom / 4)});
    return impacts;
}

std::vector<std::uint32_t> copied(std::span<const std::uint32_t> values) {
    return {values.begin(), values.end()};
}

TEST(WornSurface, GatherAndScatterGiveTheSameBitsInAnyOrderOfHits) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const scene::Relief relief = randomDepths(61, 43, seed);
        MemoryLedger ledger;
        WornSurface gathered(relief, ledger), scattered(relief, ledger);
        for (int round = 0; round < 4; ++round) {
            std::vector<Impact> impacts = randomImpacts(300, 61, 43, 10 * seed + static_cast<unsigned>(round));
            gathered.gather(impacts);
            std::ranges::shuffle(impacts, std::mt19937(seed));
            scattered.scatter(impacts);
            for (WornSurface* surface : {&gathered, &scattered}) round % 2 == 0 ? surface->takeOff() : surface->layOn();
            ASSERT_EQ(copied(gathered.depths().depths()), copied(scattered.depths().depths()));
            ASSERT_EQ(copied(gathered.hits()), copied(scattered.hits()));
            ASSERT_EQ(copied(gathered.worn()), copied(scattered.worn()));
            ASSERT_EQ(copied(gathered.laid()), copied(scattered.laid()));
        }
    }
}

// Many pits on a large surface are written in the order of tiles; some are outside the map or at its rim.
TEST(WornSurface, PitsInTheOrderOfTilesGiveTheSameBits) {
    const scene::Relief relief = randomDepths(470, 300, 5);
    MemoryLedger ledger;
    WornSurface gathered(relief, ledger), scattered(relief, ledger);
    std::vector<Impact> impacts = randomImpacts(2000, 476, 306, 8);
    std::ranges::reverse(impacts);
    impacts.insert(impacts.begin(), {-3, -3, 4, 1000});
    gathered.gather(impacts);
    scattered.scatter(impacts);
    gathered.takeOff();
    scattered.takeOff();
    EXPECT_GT(scattered.takenOffVolume(), 0u);
    EXPECT_EQ(copied(gathered.depths().depths()), copied(scattered.depths().depths()));
    EXPECT_EQ(copied(gathered.hits()), copied(scattered.hits()));
}

TEST(WornSurface, TenThousandHitsKeepTheVolumeExactly) {
    const scene::Relief relief = randomDepths(128, 64, 9);
    MemoryLedger ledger;
    WornSurface surface(relief, ledger);
    for (unsigned round = 0; round < 10; ++round) {
        surface.scatter(randomImpacts(1000, 128, 64, round));
        round % 3 == 2 ? surface.layOn() : surface.takeOff();
        ASSERT_EQ(surface.presentVolume(), surface.initialVolume() - surface.takenOffVolume() + surface.laidOnVolume());
    }
    EXPECT_GT(surface.takenOffVolume(), 0u);
    EXPECT_GT(surface.laidOnVolume(), 0u);
    std::uint64_t hits = 0;
    for (const std::uint32_t texel : surface.hits()) hits += texel;
    EXPECT_EQ(hits, 10'000u);
}

TEST(WornSurface, WhatWasLaidOnIsTakenOffFirst) {
    MemoryLedger ledger;
    WornSurface surface({2, 2, std::vector<float>(4, 0.5f), {}}, ledger);
    surface.scatter(std::vector<Impact>{{0, 0, 0, 1000}});
    surface.layOn();
    EXPECT_EQ(surface.laid()[0], 1000u);
    surface.scatter(std::vector<Impact>{{0, 0, 0, 1500}});
    surface.takeOff();
    EXPECT_EQ(surface.laid()[0], 0u);
    EXPECT_EQ(surface.worn()[0], 500u);
    EXPECT_EQ(surface.depths().depths()[0], DepthMap::bottom / 2 + 500);
    EXPECT_EQ(surface.worn()[1], 0u);
}

TEST(WornSurface, DepthStaysBetweenFaceAndBottom) {
    MemoryLedger ledger;
    WornSurface surface({2, 2, {0, 0.25f, 0.75f, 1}, {}}, ledger);
    const std::vector<Impact> deep(4, {0.5f, 0.5f, 3, DepthMap::bottom});
    surface.scatter(deep);
    surface.takeOff();
    EXPECT_EQ(copied(surface.depths().depths()), std::vector<std::uint32_t>(4, DepthMap::bottom));
    EXPECT_EQ(surface.presentVolume(), 0u);
    surface.scatter(deep);
    surface.layOn();
    EXPECT_EQ(copied(surface.depths().depths()), std::vector<std::uint32_t>(4, 0));
}

TEST(WornSurface, SaysWhatChanged) {
    MemoryLedger ledger;
    WornSurface surface(randomDepths(50, 40, 1), ledger);
    EXPECT_EQ(surface.takeChanged().endColumn, 50);
    EXPECT_TRUE(surface.takeChanged().empty());
    surface.scatter(std::vector<Impact>{{10, 20, 2, 500}});
    surface.takeOff();
    const TexelRectangle changed = surface.takeChanged();
    EXPECT_LE(changed.firstColumn, 9);
    EXPECT_GE(changed.endColumn, 12);
    EXPECT_LE(changed.endColumn - changed.firstColumn, 6);
    EXPECT_LE(changed.endRow - changed.firstRow, 6);
}

}  // namespace
}  // namespace dustbench::relief
