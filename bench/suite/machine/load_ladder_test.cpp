#include "bench/suite/machine/load_ladder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

namespace dustbench::suite {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double hd = 921'600, fullHd = 2'073'600;

/// Two methods over these loads at two sizes.
std::vector<LadderCell> twoMethods(const std::vector<double>& loads, int repetitions = 1) {
    std::vector<LadderCell> cells;
    for (const char* method : {"fast", "slow"})
        for (const double pixels : {hd, fullHd})
            for (const double load : loads)
                cells.push_back(
                    {.suite = "dust", .ladder = method, .load = load, .pixels = pixels, .repetitions = repetitions});
    return cells;
}

struct Walk {
    std::vector<LadderStep> steps;
    std::vector<std::string> skips;  ///< by step
    double elapsed = 0;
    std::size_t repetitionsLeftOut = 0;

    [[nodiscard]] std::vector<std::size_t> run(int repetition = 1) const {
        std::vector<std::size_t> cells;
        for (const LadderStep& step : steps)
            if (step.skip.empty() && step.repetition == repetition) cells.push_back(step.cell);
        return cells;
    }
    [[nodiscard]] std::string whyNot(std::size_t cell) const {
        const auto found = std::ranges::find(steps, cell, &LadderStep::cell);
        return found == steps.end() ? "never planned" : found->skip;
    }
};

/// Walks the ladder with made-up needs; a run of negative seconds fails.
Walk walk(const std::vector<LadderCell>& cells, const LadderLimits& limits,
          const std::function<RunNeeds(const LadderCell&)>& needsOf) {
    LoadLadder ladder(cells, limits);
    Walk walk;
    while (const auto step = ladder.next(walk.elapsed)) {
        walk.steps.push_back(*step);
        if (!step->skip.empty()) continue;
        const RunNeeds needs = needsOf(cells[step->cell]);
        if (needs.seconds < 0) {
            ladder.failed(*step);
            continue;
        }
        walk.elapsed += needs.allSeconds();
        ladder.done(*step, needs);
    }
    walk.repetitionsLeftOut = ladder.repetitionsLeftOut();
    return walk;
}

/// One second, and more with load and pixels; the slow method four times as much.
RunNeeds linear(const LadderCell& cell) {
    const double rate = cell.ladder == "slow" ? 4e-5 : 1e-5;
    return {.seconds = 1 + rate * cell.load * cell.pixels / hd,
            .hostBytes = 1e8 + 100 * cell.load,
            .deviceBytes = 50 * cell.load};
}

constexpr LadderLimits roomy{.totalSeconds = 1e6, .runSeconds = 1e6, .metricSeconds = 1e6};

TEST(LoadLadder, RunsTheLowestLoadsOfAllMethodsAndSizesFirst) {
    const auto cells = twoMethods({1e3, 1e4, 1e5});
    const Walk all = walk(cells, roomy, linear);
    ASSERT_EQ(all.steps.size(), cells.size());
    std::vector<double> loads, sizes;
    for (const LadderStep& step : all.steps) {
        EXPECT_EQ(step.skip, "");
        loads.push_back(cells[step.cell].load);
        sizes.push_back(cells[step.cell].pixels);
    }
    EXPECT_THAT(loads, ElementsAre(1e3, 1e3, 1e3, 1e3, 1e4, 1e4, 1e4, 1e4, 1e5, 1e5, 1e5, 1e5));
    EXPECT_THAT(sizes, ElementsAre(hd, hd, fullHd, fullHd, hd, hd, fullHd, fullHd, hd, hd, fullHd, fullHd));
}

TEST(LoadLadder, TheLimitOfARunCutsTheTopOfEachLadderAlone) {
    const auto cells = twoMethods({1e3, 1e4, 1e5, 1e6});
    LadderLimits limits = roomy;
    limits.runSeconds = 8;
    const Walk cut = walk(cells, limits, linear);
    ASSERT_EQ(cut.steps.size(), cells.size()) << "each cell is run or left out with a reason";
    for (std::size_t i = 0; i < cells.size(); ++i)
        EXPECT_EQ(cut.whyNot(i).empty(), linear(cells[i]).seconds <= 8) << cells[i].ladder << cells[i].load;
    EXPECT_THAT(cut.whyNot(3), HasSubstr("would take about 11 s, allowed: 8.0 s for one run"));
    EXPECT_EQ(cut.whyNot(14), "would take about 9.8 s, allowed: 8.0 s for one run");
    EXPECT_EQ(cut.whyNot(15), "the lower load 100000 was left out");
}

TEST(LoadLadder, TheLimitOfAllRunsCutsTheTopAndIsKept) {
    const auto cells = twoMethods({1e3, 1e4, 1e5, 1e6}, 2);
    LadderLimits limits = roomy;
    limits.totalSeconds = 30;
    const Walk cut = walk(cells, limits, linear);
    EXPECT_LE(cut.elapsed, 1.02 * limits.totalSeconds) << "as well as the predictions are";
    std::set<double> whole{1e3, 1e4}, run;
    for (const std::size_t cell : cut.run()) run.insert(cells[cell].load);
    EXPECT_TRUE(std::ranges::includes(run, whole));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string whyNot = cut.whyNot(i);
        EXPECT_TRUE(cells[i].load > 1e4 || whyNot.empty()) << cells[i].ladder << cells[i].load << whyNot;
        EXPECT_FALSE(cells[i].load == 1e6 && whyNot.empty()) << cells[i].ladder;
    }
    EXPECT_THAT(cut.whyNot(15), testing::AnyOf(HasSubstr("for all runs"), HasSubstr("lower load")));
}

TEST(LoadLadder, ASpentTotalLeavesOutTheRestWithItsReason) {
    const auto cells = twoMethods({1e3, 1e4}, 3);
    LadderLimits limits = roomy;
    limits.totalSeconds = 4;
    LoadLadder ladder(cells, limits);
    const auto first = ladder.next(0);
    ladder.done(*first, linear(cells[first->cell]));
    for (std::size_t i = 1; i < cells.size(); ++i) {
        const auto step = ladder.next(4);
        EXPECT_THAT(step->skip,
                    testing::AnyOf("the limit of 4.0 s for all runs is reached", "the lower load 1000 was left out"));
    }
    EXPECT_FALSE(ladder.next(4));
    EXPECT_EQ(ladder.repetitionsLeftOut(), 2u) << "of the one that ran";
}

TEST(LoadLadder, MemoryCutsTheTopByWhatIsShort) {
    const auto cells = twoMethods({1e3, 1e4, 1e5, 1e6});
    LadderLimits limits = roomy;
    limits.deviceBytes = 1e7;
    const Walk cut = walk(cells, limits, linear);
    EXPECT_EQ(cut.whyNot(3), "would need about 49.5 MB of GPU memory, allowed: 10.0 MB");
    limits = roomy;
    limits.hostBytes = 1.5e8;
    EXPECT_EQ(walk(cells, limits, linear).whyNot(3), "would need about 199 MB of memory, allowed: 150 MB");
    EXPECT_EQ(walk(cells, limits, linear).whyNot(2), "");
}

TEST(LoadLadder, NothingIsTriedAboveWhatFailed) {
    const auto cells = twoMethods({1e3, 1e4, 1e5});
    const auto needs = [](const LadderCell& cell) {
        RunNeeds made = linear(cell);
        if (cell.ladder == "slow" && cell.load == 1e4 && cell.pixels == hd) made.seconds = -1;
        return made;
    };
    const Walk cut = walk(cells, roomy, needs);
    EXPECT_EQ(cut.whyNot(8), "the lower load 10000 failed");
    EXPECT_EQ(cut.whyNot(10), "a smaller picture failed");
    EXPECT_EQ(cut.whyNot(11), "the lower load 10000 was left out");
    for (std::size_t fast = 0; fast < 6; ++fast) EXPECT_EQ(cut.whyNot(fast), "");
}

TEST(LoadLadder, PredictsTheGrowthOfWhatARunTakesBeyondTheLeastOfItsSuite) {
    const std::vector<LadderCell> cells{{.suite = "dust", .ladder = "a", .load = 10, .pixels = hd},
                                        {.suite = "dust", .ladder = "a", .load = 100, .pixels = hd},
                                        {.suite = "dust", .ladder = "b", .load = 10, .pixels = hd},
                                        {.suite = "dust", .ladder = "b", .load = 10, .pixels = 2 * hd},
                                        {.suite = "other", .ladder = "a", .load = 10, .pixels = hd}};
    LoadLadder ladder(cells, roomy);
    EXPECT_FALSE(ladder.predicted(1));
    ladder.done({.cell = 4}, {.seconds = 0.1});
    ladder.done({.cell = 2}, {.seconds = 2, .hostBytes = 100});
    ladder.done({.cell = 0}, {.seconds = 5, .hostBytes = 400});
    EXPECT_DOUBLE_EQ(ladder.predicted(1)->seconds, 2 + 3 * 10);
    EXPECT_DOUBLE_EQ(ladder.predicted(1)->hostBytes, 100 + 300 * 10);
    EXPECT_DOUBLE_EQ(ladder.predicted(3)->seconds, 2) << "the least itself: its growth is not known";
}

TEST(LoadLadder, ARunWhosePicturesTakeTooLongToCompareIsMeasuredWithoutThem) {
    std::vector<LadderCell> cells = twoMethods({1e3, 1e4, 1e5}, 2);
    for (LadderCell& cell : cells) cell.evaluated = cell.pixels == hd && cell.load <= 1e4;
    LadderLimits limits = roomy;
    limits.metricSeconds = 20;
    const auto needs = [](const LadderCell& cell) {
        RunNeeds made = linear(cell);
        if (cell.evaluated && cell.load == 1e3) made.metricSeconds = cell.load / 200;
        return made;
    };
    const Walk cut = walk(cells, limits, needs);
    EXPECT_EQ(cut.whyNot(0), "");
    EXPECT_EQ(cut.whyNot(1), "comparing its pictures would take about 50 s, allowed: 20 s");
    EXPECT_EQ(cut.whyNot(2), "") << "a higher load without metrics";
    EXPECT_EQ(cut.whyNot(4), "") << "a larger size without metrics";
    const auto skipped =
        std::ranges::find_if(cut.steps, [](const LadderStep& step) { return step.cell == 1 && step.repetition == 1; });
    EXPECT_EQ(std::next(skipped)->cell, 1u);
    EXPECT_EQ(std::next(skipped)->repetition, 2);
    EXPECT_EQ(cut.steps.size(), 2 * cells.size()) << "each run once";
    for (LadderCell& cell : cells) cell.repetitions = 1;
    EXPECT_EQ(walk(cells, limits, needs).whyNot(2), "") << "nor does the gap end the ladder";
}

TEST(LoadLadder, RepeatsWhatRanAsLongAsTimeRemains) {
    const auto cells = twoMethods({1e3, 1e4}, 3);
    const Walk all = walk(cells, roomy, linear);
    EXPECT_EQ(all.steps.size(), 3 * cells.size());
    EXPECT_EQ(all.repetitionsLeftOut, 0u);
    EXPECT_NE(all.run(2), all.run(3)) << "another order within each world";

    LadderLimits limits = roomy;
    limits.totalSeconds = walk(twoMethods({1e3, 1e4}), roomy, linear).elapsed + 5;
    const Walk cut = walk(cells, limits, linear);
    EXPECT_EQ(cut.run(1).size(), cells.size());
    EXPECT_GT(cut.run(2).size(), 0u);
    EXPECT_LT(cut.run(2).size(), cells.size());
    EXPECT_THAT(cut.run(3), IsEmpty());
    EXPECT_EQ(cut.repetitionsLeftOut + cut.run(2).size(), 2 * cells.size());
    EXPECT_LE(cut.elapsed, limits.totalSeconds);
}

}  // namespace
}  // namespace dustbench::suite
