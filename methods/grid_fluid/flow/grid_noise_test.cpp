// Tests the measure of noise with known waves, white noise and solids.
#include "methods/grid_fluid/flow/grid_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace dustbench::grid_fluid::flow {
namespace {

constexpr glm::ivec3 cells{6, 40, 5};

template <typename Value>
std::vector<float> field(const Value& value) {
    std::vector<float> values;
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) values.push_back(static_cast<float>(value(i, j, k)));
    return values;
}

/// Waves of a given length in cells along the vertical.
std::vector<float> waves(double length, double mean = 0) {
    return field([&](int i, int j, int k) { return mean + std::cos(2 * std::numbers::pi * j / length + i + 2 * k); });
}

TEST(GridNoise, IsTheShareOfWavesShorterThanTwoAndAHalfCells) {
    EXPECT_NEAR(gridNoise(waves(20), {}, cells), 0, 1e-4);
    EXPECT_NEAR(gridNoise(waves(20, 1000), {}, cells), 0, 1e-4);  // independent of the mean
    EXPECT_NEAR(gridNoise(waves(4), {}, cells), 0, 1e-3);
    EXPECT_NEAR(gridNoise(waves(2.2), {}, cells), 1, 1e-3);
    EXPECT_NEAR(gridNoise(field([](int, int j, int) { return j % 2 == 0 ? 1 : -1; }), {}, cells), 1, 1e-3);
}

TEST(GridNoise, AddsPowersNotAmplitudes) {
    // A wave of ten cells and a tenth of its amplitude as speckle: 0.01/1.01.
    const std::vector<float> slow = waves(10), fast = waves(2.2);
    std::vector<float> both;
    for (std::size_t at = 0; at < slow.size(); ++at) both.push_back(slow[at] + 0.1f * fast[at]);
    EXPECT_NEAR(gridNoise(both, {}, cells), 0.01 / 1.01, 2e-4);
}

TEST(GridNoise, OfWhiteNoiseIsAFifth) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::mt19937 random(seed);
        std::normal_distribution<float> value;
        // 30 columns of four of twenty frequencies: the share scatters by about 0.02.
        EXPECT_NEAR(gridNoise(field([&](int, int, int) { return value(random); }), {}, cells), 0.2, 0.06) << seed;
    }
}

TEST(GridNoise, LeavesOutColumnsWithSolids) {
    std::vector<float> values = waves(20);
    std::vector<std::uint8_t> solids(values.size());
    for (int j = 0; j < cells.y; ++j) values[static_cast<std::size_t>(j * cells.x + 2)] = j % 2 == 0 ? 5 : -5;
    EXPECT_GT(gridNoise(values, solids, cells), 0.1);
    solids[static_cast<std::size_t>(7 * cells.x + 2)] = 3;
    EXPECT_NEAR(gridNoise(values, solids, cells), 0, 1e-4);
}

TEST(GridNoise, IsNoneWhereNothingVaries) {
    EXPECT_EQ(gridNoise(field([](int, int, int) { return 7; }), {}, cells), 0);
    EXPECT_EQ(gridNoise(std::vector<float>(4 * 9 * 4, 1.0f), {}, {4, 9, 4}), 0);
}

}  // namespace
}  // namespace dustbench::grid_fluid::flow
