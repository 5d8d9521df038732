#include "bench/measure/clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace dustbench::bench {

TEST(Clock, OneLookCostsLessThanAStage) {
    const ClockCost cost = measureClockCost();
    EXPECT_GT(cost.readingNs, 0);
    EXPECT_GT(cost.stageNs, cost.readingNs);
}

TEST(Clock, TheProcessGrowsOlderByWhatPasses) {
    using namespace std::chrono_literals;
    constexpr double step = 0.011;  // the process age has a resolution of 10 ms, rounded down
    const auto seconds = [](std::int64_t from, std::int64_t to) { return static_cast<double>(to - from) * 1e-9; };
    const std::int64_t beforeFirst = steadyNow();
    const double before = secondsSinceProcessStart();
    const std::int64_t afterFirst = steadyNow();
    std::this_thread::sleep_for(50ms);
    const std::int64_t beforeSecond = steadyNow();
    const double after = secondsSinceProcessStart();
    const std::int64_t afterSecond = steadyNow();
    EXPECT_GT(before, -step);
    EXPECT_GE(after - before, seconds(afterFirst, beforeSecond) - step);
    EXPECT_LE(after - before, seconds(beforeFirst, afterSecond) + step);
}

}  // namespace dustbench::bench
