#include "bench/reference/judge/judging_plan.h"

#include <gmock/gmock.h>

#include "bench/reference/judge/judgement.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::reference {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(MetricPlan, TakesFiveMomentsFromTheFirstFrameToTheLast) {
    const MetricPlan plan;
    EXPECT_THAT(plan.momentsOf(120), ElementsAre(0, 29, 59, 89, 119));
    EXPECT_THAT(plan.momentsOf(5), ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(plan.momentsOf(1), ElementsAre(0));
    EXPECT_THAT(plan.momentsOf(3), ElementsAre(0, 1, 2));
}

TEST(MetricPlan, TakesTheMomentsThatAreNamed) {
    const MetricPlan plan{exports::FrameRange{2, 14, 3}, {}};
    EXPECT_THAT(plan.momentsOf(120), ElementsAre(2, 5, 8, 11, 14));
    EXPECT_NO_THROW(requireMomentsWithinRun(plan, 15));
    EXPECT_THAT(inputError([&] { requireMomentsWithinRun(plan, 14); }), HasSubstr("frame 14 is beyond"));
    EXPECT_THAT(inputError([] {
                    requireMomentsWithinRun({exports::FrameRange{0, 3, 1}, {}}, 100);
                }),
                HasSubstr("got 4 frames (0:4:1)"));
}

TEST(MetricPlan, PoppingIsSeenOverTheLastFramesOrNotAtAll) {
    EXPECT_THAT(MetricPlan::stretchOf(30), IsEmpty());
    EXPECT_EQ(MetricPlan::stretchOf(31).size(), 31u);
    EXPECT_EQ(MetricPlan::stretchOf(100).front(), 69);
    EXPECT_EQ(MetricPlan::stretchOf(100).back(), 99);
}

TEST(RunMetrics, AveragesOverTheMomentsAtWhichAMetricIsDefined) {
    RunMetrics runMetrics;
    runMetrics.frames.resize(3);
    const auto set = [&](std::size_t frame, const char* column, double value) {
        runMetrics.frames[frame].values.set(column, value);
    };
    set(0, "psnr_db", 30);
    set(0, "identical", 0);
    set(1, "psnr_db", 40);
    set(1, "identical", 0);
    set(2, "identical", 1);
    set(2, "flip", 0);
    runMetrics.ofRun.set("popping_max", 0.5);
    EXPECT_THAT(summaryOf(runMetrics),
                ElementsAre(Pair("psnr_db", 35), Pair("flip", 0), Pair("identical", 0), Pair("popping_max", 0.5)));
    runMetrics.frames.erase(runMetrics.frames.begin(), runMetrics.frames.begin() + 2);
    EXPECT_THAT(summaryOf(runMetrics), testing::Contains(Pair("identical", 1)));
}

TEST(RunMetrics, LeavesCellsEmptyWhereNothingIsDefined) {
    RunMetrics runMetrics;
    runMetrics.frames.resize(1);
    runMetrics.frames[0].frame = 7;
    runMetrics.frames[0].timeSeconds = 0.5;
    runMetrics.frames[0].values.set("popping", 0.25);
    const auto table = files::CsvTable::parseText(metricsCsv(runMetrics), "metrics.csv");
    for (const std::string& column : table.header()) {
        const char* expected = column == "frame" ? "7" : column == "time_s" ? "0.5" : column == "popping" ? "0.25" : "";
        EXPECT_EQ(table.cell(0, column), expected) << column;
    }
}

}  // namespace
}  // namespace dustbench::reference
