// Checks that the trees are valid for NanoVDB: its functions validate them and read back every value.
#include "methods/volume/sparse/nano_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nanovdb/util/GridValidator.h>

#include <limits>
#include <map>
#include <random>
#include <tuple>

#include "methods/kit/testing/test_input_error.h"
#include "methods/volume/sparse/nano_walk.h"

namespace dustbench::volume {
namespace {

constexpr std::size_t noLimit = std::numeric_limits<std::size_t>::max();

using Cells = std::map<std::tuple<int, int, int>, float>;

/// Cells in clusters around places near and far, some below zero.
Cells scattered(unsigned seed) {
    std::mt19937 random(seed);
    Cells cells;
    for (int cluster = 0; cluster < 12; ++cluster) {
        const auto far = [&] { return static_cast<int>(random() % 20'000) - 10'000; };
        const glm::ivec3 middle = cluster < 6 ? glm::ivec3(far(), far(), far()) / 50 : glm::ivec3(far(), far(), far());
        for (int i = 0; i < 60; ++i) {
            const auto near = [&] { return static_cast<int>(random() % 13) - 6; };
            cells[{middle.x + near(), middle.y + near(), middle.z + near()}] = 0.5f + static_cast<float>(i);
        }
    }
    return cells;
}

void put(const Cells& cells, Bricks& bricks) {
    for (const auto& [at, value] : cells) {
        const auto [x, y, z] = at;
        bricks.at(glm::ivec3(x, y, z) >> 3)[static_cast<std::size_t>((x & 7) << 6 | (y & 7) << 3 | (z & 7))] = value;
    }
}

TEST(NanoTree, IsReadByNanoVdbWithEveryValue) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const Cells cells = scattered(seed);
        Bricks bricks;
        put(cells, bricks);
        MemoryLedger ledger;
        NanoTree tree(ledger.account("test"));
        plantDensities(bricks, 0.25, {1, 2, 3}, noLimit, tree);
        const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<float>*>(tree.bytes().data());
        ASSERT_EQ(nanovdb::GridValidator<float>::check(grid, /*detailed=*/true), "");
        EXPECT_EQ(grid.gridSize(), tree.bytes().size());
        EXPECT_EQ(grid.tree().nodeCount(0), bricks.count());
        const auto accessor = grid.getAccessor();
        double sum = 0;
        for (const auto& [at, value] : cells) {
            const auto [x, y, z] = at;
            ASSERT_EQ(accessor.getValue({x, y, z}), value);
            sum += static_cast<double>(value);
        }
        EXPECT_DOUBLE_EQ(tree.sum(), sum);
        const nanovdb::Vec3d middle = grid.indexToWorld(nanovdb::Vec3d(4.0, 0.0, 0.0));
        EXPECT_EQ(glm::dvec3(middle[0], middle[1], middle[2]), glm::dvec3(2.125, 2.125, 3.125));
    }
}

TEST(NanoTree, IsActiveJustWhereSamplesSeeDensity) {
    const Cells cells = scattered(7);
    Bricks bricks;
    put(cells, bricks);
    MemoryLedger ledger;
    NanoTree tree(ledger.account("test"));
    plantDensities(bricks, 1, {0, 0, 0}, noLimit, tree);
    const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<float>*>(tree.bytes().data());
    const auto accessor = grid.getAccessor();
    NanoWalk walk(tree);
    for (const auto& [at, value] : cells) {
        const auto [x, y, z] = at;
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 cell(x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1);
            bool seesDensity = false;
            for (int corner = 0; corner < 8; ++corner)
                seesDensity |=
                    cells.contains({cell.x + (corner & 1), cell.y + (corner >> 1 & 1), cell.z + (corner >> 2)});
            const NanoWalk::Found found = walk.at(cell >> 3);
            EXPECT_EQ(found.values != nullptr, bricks.find(cell >> 3) != nullptr);
            if (seesDensity) {
                ASSERT_TRUE(accessor.isActive({cell.x, cell.y, cell.z}));
                ASSERT_EQ(found.emptyEdge, 0);
            } else if (found.values) {
                ASSERT_FALSE(accessor.isActive({cell.x, cell.y, cell.z}));
            }
            const glm::ivec3 in = cell & 7;
            if (found.active) {
                ASSERT_EQ((found.active[in.x] >> (in.y * 8 + in.z) & 1) != 0, seesDensity);
            }
        }
    }
    EXPECT_EQ(walk.at({1 << 19, 0, 0}).emptyEdge, 4096);
    EXPECT_THAT(walk.at((tree.brickOf(0) & ~511) + ((tree.brickOf(0) & 511) ^ 256)).emptyEdge,
                testing::AnyOf(128, 8, 0));
}

TEST(NanoTree, TakesWhatItsLeavesTakeAndNoMoreThanItMay) {
    Bricks bricks;
    for (int i = 0; i < 4096; ++i) bricks.at({i % 16, i / 16 % 16, i / 256}).fill(1);
    MemoryLedger ledger;
    NanoTree tree(ledger.account("test"));
    plantDensities(bricks, 1, {0, 0, 0}, noLimit, tree);
    // A full node of 128³ cells; the tiles around it are in seven others of each kind.
    EXPECT_LT(static_cast<double>(tree.bytes().size()) / (4096 * 2144 + 8 * (270'400 + 33'856)), 1.01);
    EXPECT_GE(ledger.totalBytes(), tree.bytes().size());
    EXPECT_THAT(inputError([&] {
                    plantDensities(bricks, 1, {0, 0, 0}, 1'000'000, tree);
                }),
                testing::HasSubstr("the tree of the volume takes 0.0112 GB, allowed: 0.001 GB"));
}

}  // namespace
}  // namespace dustbench::volume
