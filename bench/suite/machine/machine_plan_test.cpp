#include "bench/suite/machine/machine_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "bench/results/compared_runs.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

TEST(MachinePlan, PlacesEachCellOfItsSuitesOnce) {
    for (const bool quick : {false, true}) {
        const MachinePlan plan = loadMachinePlan(quick);
        const std::vector<PlacedCell> cells = cellsOf(plan);
        std::set<std::string> places, ids;
        for (const PlacedCell& cell : cells) {
            const LadderCell& at = cell.ladder;
            places.insert(at.suite + at.ladder + std::to_string(at.load) + " " + std::to_string(at.pixels));
            ids.insert(runId(cell.run.spec));
        }
        EXPECT_EQ(places.size(), cells.size());
        EXPECT_EQ(ids.size(), cells.size()) << "no run belongs to two suites";
        EXPECT_LT(plan.hardware.totalSeconds, 600 + 1);
        EXPECT_LT(plan.software.totalSeconds, 1800 + 1);
    }
}

TEST(MachinePlan, JudgesPicturesAtTheSmallestSizeAlone) {
    double smallest = 1e12;
    const std::vector<PlacedCell> cells = cellsOf(loadMachinePlan(false));
    for (const PlacedCell& cell : cells) smallest = std::min(smallest, cell.ladder.pixels);
    bool evaluates = false;
    for (const PlacedCell& cell : cells) {
        EXPECT_TRUE(!cell.ladder.evaluated || cell.ladder.pixels == smallest);
        evaluates = evaluates || cell.ladder.evaluated;
    }
    EXPECT_TRUE(evaluates);
}

TEST(MachinePlan, ALoadIsANumberOrTheCellsOfAGrid) {
    EXPECT_EQ(loadOf("1000"), 1000);
    EXPECT_EQ(loadOf("128x64x32"), 128 * 64 * 32);
    for (const char* wrong : {"", "all", "0", "12x", "x12", "-3"}) EXPECT_THROW((void)loadOf(wrong), InputError);
}

TEST(MachinePlan, TellsJudgingFromMeasuring) {
    StoredRun run;
    run.cells = {{"run_s", "10"}, {"start_s", "2"}, {"fps_avg", "20"}, {"rss_peak_bytes", "5000"}, {"gpu_bytes", "70"}};
    RunSpec spec;
    spec.warmup = 10;
    spec.frames = 50;
    RunNeeds needs = needsOf(run, spec);
    EXPECT_DOUBLE_EQ(needs.seconds, 10);
    EXPECT_DOUBLE_EQ(needs.metricSeconds, 0);
    EXPECT_DOUBLE_EQ(needs.hostBytes, 5000);
    EXPECT_DOUBLE_EQ(needs.deviceBytes, 70);
    spec.metricPlan.emplace();
    needs = needsOf(run, spec);
    EXPECT_DOUBLE_EQ(needs.seconds, 5);
    EXPECT_DOUBLE_EQ(needs.metricSeconds, 5);
}

}  // namespace
}  // namespace dustbench::bench
