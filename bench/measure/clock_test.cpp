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
    const double before = secondsSinceProcessStart();
    const std::int64_t begin = steadyNow();
    std::this_thread::sleep_for(50ms);
    const double passed = static_cast<double>(steadyNow() - begin) * 1e-9;
    EXPECT_GT(before, -0.011);  // in steps of 10 ms, rounded down
    EXPECT_NEAR(secondsSinceProcessStart() - before, passed, 0.02);
}

}  // namespace dustbench::bench
