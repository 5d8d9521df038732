#include "methods/relief/surface/depth_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "methods/relief/surface/worn_surface.h"

namespace dustbench::relief {
namespace {

scene::Relief randomRelief(int columns, int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> depth(0, 1);
    scene::Relief relief{columns, rows, {}, {}};
    for (int i = 0; i < columns * rows; ++i) relief.depth.push_back(depth(random));
    return relief;
}

TEST(DepthPyramid, EachBlockIsTheMinimumOfItsTexels) {
    for (const auto& [columns, rows] : std::vector<std::pair<int, int>>{{2, 2}, {17, 9}, {64, 33}}) {
        MemoryLedger ledger;
        const DepthMap map(randomRelief(columns, rows, 3), ledger);
        const DepthPyramid pyramid(map, ledger);
        EXPECT_EQ(pyramid.levels().front().columns, columns + 1);
        EXPECT_EQ(pyramid.levels().back().columns, 1);
        EXPECT_EQ(pyramid.levels().back().rows, 1);
        for (std::size_t k = 0; k < pyramid.levels().size(); ++k) {
            const DepthPyramid::Level& level = pyramid.levels()[k];
            const int edge = 1 << k;
            for (int j = 0; j < level.rows; ++j)
                for (int i = 0; i < level.columns; ++i) {
                    double nearest = 1;
                    for (int row = j * edge - 1; row <= std::min((j + 1) * edge, rows) - 1 + 1; ++row)
                        for (int column = i * edge - 1; column <= std::min((i + 1) * edge, columns); ++column)
                            if (row < (j + 1) * edge && column < (i + 1) * edge)
                                nearest = std::min(nearest, map.at(column, row));
                    ASSERT_FLOAT_EQ(pyramid.blocks()[level.offset + static_cast<std::size_t>(j * level.columns + i)],
                                    static_cast<float>(nearest))
                        << columns << " level " << k << " block " << i << " " << j;
                }
        }
    }
}

TEST(DepthPyramid, UpdatingWhatChangedGivesThePyramidOfTheNewDepths) {
    MemoryLedger ledger;
    WornSurface surface(randomRelief(53, 37, 8), ledger);
    DepthPyramid pyramid(surface.depths(), ledger);
    static_cast<void>(surface.takeChanged());
    std::mt19937 random(2);
    std::uniform_real_distribution<float> share(0, 1);
    for (int round = 0; round < 50; ++round) {
        const std::vector<Impact> impacts{
            {53 * share(random) - 0.5f, 37 * share(random) - 0.5f, 5 * share(random), DepthMap::bottom / 2}};
        surface.scatter(impacts);
        round % 2 == 0 ? surface.takeOff() : surface.layOn();
        pyramid.update(surface.depths(), surface.takeChanged());
        const DepthPyramid whole(surface.depths(), ledger);
        ASSERT_TRUE(std::ranges::equal(pyramid.blocks(), whole.blocks())) << round;
    }
}

}  // namespace
}  // namespace dustbench::relief
