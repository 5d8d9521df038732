#include "bench/measure/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace dustbench::measure {

TEST(Statistics, QuantilesOfARampAreTheRamp) {
    std::vector<double> ramp(101);
    std::iota(ramp.begin(), ramp.end(), 0.0);
    std::shuffle(ramp.begin(), ramp.end(), std::mt19937(7));
    for (const double p : {0.0, 0.25, 0.5, 0.95, 0.99, 0.995, 1.0}) EXPECT_NEAR(quantile(ramp, p), 100 * p, 1e-12);
}

TEST(Statistics, MedianOfAnEvenCountLiesHalfWay) {
    EXPECT_EQ(median(std::vector<double>{4, 1, 3, 2}), 2.5);
    EXPECT_EQ(median(std::vector<double>{9, 1, 3}), 3);
}

TEST(Statistics, FpsIsFramesOverTime) {
    // One frame of 10 ms and one of 90 ms: 2 frames in 0.1 s. The mean of the rates would be 55.6.
    EXPECT_DOUBLE_EQ(averageFps(std::vector<double>{10, 90}), 20);
}

TEST(Statistics, OnePercentLowWeighsByTime) {
    // 9,900 frames of 10 ms and one stall of 1,000 ms: the stall is 0.01 % of the frames but 1 % of the time.
    std::vector<double> frames(9'900, 10.0);
    frames.push_back(1'000);
    EXPECT_DOUBLE_EQ(lowFps(frames), 1);
    // Half as long: 0.5 % of the time, so the 1 % includes ordinary frames.
    frames.back() = 500;
    EXPECT_DOUBLE_EQ(lowFps(frames), 100);
    // Equal frames: the low is the average.
    EXPECT_DOUBLE_EQ(lowFps(std::vector<double>(50, 20.0)), 50);
}

TEST(Statistics, NothingGivesNaN) {
    EXPECT_TRUE(std::isnan(median({})));
    EXPECT_TRUE(std::isnan(maximum({})));
    EXPECT_TRUE(std::isnan(minimum({})));
    EXPECT_TRUE(std::isnan(averageFps({})));
    EXPECT_TRUE(std::isnan(lowFps({})));
}

}  // namespace dustbench::measure
