#include "bench/measure/clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>
#include <thread>

namespace dustbench::measure {
namespace {

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

/// A clock that advances only on request.
struct FakeTime {
    std::int64_t now = 1'000;
    StageRecorder recorder{[this] { return now; }};
    StageClock clock{&recorder};

    [[nodiscard]] std::int64_t of(Stage stage) const { return recorder.stageNs()[static_cast<std::size_t>(stage)]; }
    [[nodiscard]] std::int64_t ofAllStages() const {
        return std::accumulate(recorder.stageNs().begin(), recorder.stageNs().end(), std::int64_t{0});
    }
};

TEST(StageRecorder, GivesANestedStageItsOwnTimeAlone) {
    FakeTime time;
    {
        const auto build = time.clock.measure(Stage::build);
        time.now += 5;
        {
            const auto sort = time.clock.measure(Stage::sort);
            time.now += 30;
            {
                const auto upload = time.clock.measure(Stage::upload);
                time.now += 200;
            }
            time.now += 40;
        }
        time.now += 6;
    }
    time.now += 1'000;  // between stages: not counted
    {
        const auto draw = time.clock.measure(Stage::draw);
        time.now += 3;
    }
    EXPECT_EQ(time.of(Stage::build), 11);
    EXPECT_EQ(time.of(Stage::sort), 70);
    EXPECT_EQ(time.of(Stage::upload), 200);
    EXPECT_EQ(time.of(Stage::draw), 3);
    EXPECT_EQ(time.ofAllStages(), 284);
}

TEST(StageRecorder, SumsAStageThatComesTwice) {
    FakeTime time;
    for (int i = 0; i < 3; ++i) {
        const auto sort = time.clock.measure(Stage::sort);
        time.now += 7;
    }
    EXPECT_EQ(time.of(Stage::sort), 21);
}

TEST(StageRecorder, ChargesQueuedWorkToTheStageThatQueuedIt) {
    FakeTime time;
    std::int64_t queued = 0;
    time.recorder.setFence([&] {
        time.now += queued;
        queued = 0;
    });
    {
        const auto build = time.clock.measure(Stage::build);
        queued = 50;  // of the outer stage, still queued when the inner one begins
        const auto upload = time.clock.measure(Stage::upload);
        queued = 400;
    }
    EXPECT_EQ(time.of(Stage::build), 50);
    EXPECT_EQ(time.of(Stage::upload), 400);
}

TEST(StageRecorder, MeasuresDetailsWithinTheirStage) {
    FakeTime time;
    for (int step = 0; step < 2; ++step) {
        const auto build = time.clock.measure(Stage::build);
        {
            const auto advect = time.clock.measureDetail("advect");
            time.now += 10;
            const auto clamp = time.clock.measureDetail("clamp");
            time.now += 4;
        }
        time.now += 1;
    }
    const auto& details = time.recorder.details();
    ASSERT_EQ(details.size(), 2u);
    EXPECT_EQ(details[0].name, "advect");
    EXPECT_EQ(details[0].stage, Stage::build);
    EXPECT_EQ(details[0].ns, 20);
    EXPECT_EQ(details[1].ns, 8);
    EXPECT_EQ(time.of(Stage::build), 30);
}

TEST(StageRecorder, ForgetsTheLastFrame) {
    FakeTime time;
    {
        const auto draw = time.clock.measure(Stage::draw);
        const auto detail = time.clock.measureDetail("march");
        time.now += 9;
    }
    time.recorder.clear();
    EXPECT_EQ(time.ofAllStages(), 0);
    EXPECT_TRUE(time.recorder.details().empty());
}

}  // namespace
}  // namespace dustbench::measure
