#include "bench/recommend/rankings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/recommend/test_table.h"
#include "methods/contract/errors.h"

namespace dustbench::recommend {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const measure::Metric psnrMetric = qualityMetric("", "psnr_mask_db");

Rankings rankOf(const std::vector<TestRow>& rows) {
    return rankSettings(runsOf(rows), psnrMetric);
}

TEST(Rankings, NeverMixWorlds) {
    for (TestRow other : {TestRow{.particles = 2000}, TestRow{.size = "640"}}) {
        std::vector<TestRow> rows;
        add(rows, "a", {1, 2, 3}, "30");
        other.ms = "9";
        other.psnr = "40";
        rows.push_back(other);
        const Rankings rankings = rankOf(rows);
        ASSERT_THAT(rankings.rankings, SizeIs(2));
        EXPECT_EQ(rankings.rankings[0].settings.at(0).ms.values + rankings.rankings[1].settings.at(0).ms.values, 4U);
    }
}

TEST(Rankings, NeverMixWaysOfTiming) {
    EXPECT_THAT(rankOf({{.ms = "1", .psnr = "30"}, {.ms = "9", .psnr = "30", .frames = "400"}}).rankings, SizeIs(2));
    EXPECT_THAT(rankOf({{.ms = "1", .psnr = "30"}, {.ms = "9", .psnr = "30", .dustOn = "gpu"}}).rankings, SizeIs(2));
}

TEST(Rankings, NeverMixReferences) {
    EXPECT_THAT(rankOf({{.method = "a", .ms = "1", .psnr = "30"},
                        {.method = "b", .ms = "1", .psnr = "30", .reference = "depth=10"},
                        {.method = "c", .ms = "1", .psnr = "30", .reference = "depth=10"}})
                    .rankings,
                SizeIs(3));
}

TEST(Rankings, NeverMixMachines) {
    MeasuredRuns runs = runsOf({{.ms = "1", .psnr = "30"}, {.ms = "9", .psnr = "30", .repetition = 2}});
    EXPECT_THAT(rankSettings(runs, psnrMetric).rankings, SizeIs(1));
    runs.machines.emplace_back();
    runs.runs.back().machine = 1;
    EXPECT_THAT(rankSettings(runs, psnrMetric).rankings, SizeIs(2));
}

TEST(Rankings, KeepSettingsOfAMethodApart) {
    const Rankings rankings = rankOf({{.ms = "1", .psnr = "30"}, {.ms = "9", .psnr = "40", .depth = "9"}});
    ASSERT_THAT(rankings.rankings, SizeIs(1));
    EXPECT_THAT(rankings.rankings.front().settings,
                ElementsAre(Field(&MeasuredSetting::label, "a depth=9"), Field(&MeasuredSetting::label, "a depth=8")));
}

TEST(Rankings, JoinTimesAndPicturesOfOtherRuns) {
    std::vector<TestRow> rows;
    add(rows, "a", {1, 2, 3}, "");
    for (const int seed : {1, 2, 3})
        rows.push_back({.psnr = fmt::format("{}", 30 + seed), .seed = seed, .frames = "90"});
    const Rankings rankings = rankOf(rows);
    ASSERT_THAT(rankings.rankings, SizeIs(1));
    const MeasuredSetting& setting = rankings.rankings.front().settings.at(0);
    EXPECT_EQ(setting.ms.median, 2);
    EXPECT_EQ(setting.quality.median, 32);
    EXPECT_EQ(setting.quality.values, 3U);
    EXPECT_TRUE(setting.otherRuns);
    EXPECT_EQ(rankings.rankings.front().evaluatedFrames, "90");
}

TEST(Rankings, NameSettingsWithoutATimeOrAPicture) {
    const Rankings rankings = rankOf({{.method = "timed", .ms = "1"},
                                      {.method = "judged", .psnr = "30"},
                                      {.method = "neither"},
                                      {.method = "whole", .ms = "1", .psnr = "30"},
                                      {.method = "wrong", .ms = "nan", .psnr = "30"}});
    ASSERT_THAT(rankings.rankings, SizeIs(1));
    EXPECT_THAT(rankings.rankings.front().settings, ElementsAre(Field(&MeasuredSetting::method, "whole")));
    const auto is = [](const char* label, bool hasTime, bool hasQuality) {
        return AllOf(Field(&Incomplete::label, HasSubstr(label)), Field(&Incomplete::hasTime, hasTime),
                     Field(&Incomplete::hasQuality, hasQuality));
    };
    EXPECT_THAT(rankings.incomplete, ElementsAre(is("judged", false, true), is("neither", false, false),
                                                 is("timed", true, false), is("wrong", false, true)));
}

TEST(Rankings, TakeTheMedianOverSeedsOfTheMediansOverRepetitions) {
    std::vector<TestRow> rows;
    for (const int seed : {1, 2, 3})
        for (const int repetition : {1, 2, 3})
            rows.push_back({.ms = fmt::format("{}", 10 * seed + repetition),
                            .psnr = "30",
                            .seed = seed,
                            .repetition = repetition});
    const Rankings rankings = rankOf(rows);
    const report::MedianInterval& ms = rankings.rankings.at(0).settings.at(0).ms;
    EXPECT_EQ(ms.median, 22);
    EXPECT_EQ(ms.low, 12);
    EXPECT_EQ(ms.high, 32);
}

TEST(Rankings, HaveAFrontWhereIntervalsSeparate) {
    std::vector<TestRow> rows;
    add(rows, "best", {7, 8, 9}, "40");
    add(rows, "beaten", {7, 8, 9}, "35");
    add(rows, "cheap", {1, 2, 3}, "30");
    const Rankings rankings = rankOf(rows);
    const auto front = [](const char* method, bool isOnFront) {
        return AllOf(Field(&MeasuredSetting::method, method), Field(&MeasuredSetting::onFront, isOnFront));
    };
    EXPECT_THAT(rankings.rankings.at(0).settings,
                ElementsAre(front("best", true), front("beaten", false), front("cheap", true)));
}

TEST(MeasuredRuns, LeaveOutWhatIsInvalidOrNotDoneAndCountIt) {
    const MeasuredRuns runs = runsOf({{.ms = "1", .psnr = "30"},
                                      {.ms = "9", .psnr = "90", .invalid = "clipped is 3"},
                                      {.ms = "9", .psnr = "90", .invalid = "clipped is 3"},
                                      {.ms = "9", .psnr = "90", .status = "failed"},
                                      {.method = "null_method", .ms = "9"}});
    EXPECT_EQ(runs.notDone, 1U);
    EXPECT_EQ(runs.invalid, 2U);
    EXPECT_THAT(runs.whyInvalid, ElementsAre(testing::Pair("clipped is 3", 2U)));
    const Rankings rankings = rankSettings(runs, psnrMetric);
    ASSERT_THAT(rankings.rankings, SizeIs(1));
    EXPECT_EQ(rankings.rankings.front().settings.at(0).ms.high, 1);
    EXPECT_EQ(rankings.rankings.front().settings.at(0).quality.high, 30);
    EXPECT_THAT(rankings.incomplete, IsEmpty());
}

TEST(MeasuredRuns, CountOnceHoweverOftenATableHasThem) {
    const std::string table = tableOf({{.ms = "1"}, {.ms = "2", .repetition = 2}});
    const std::string rows = table.substr(table.find('\n') + 1);
    const auto read = [](const std::string& text) {
        return measuredRuns(files::CsvTable::parseText(text, "summary.csv"), "summary.csv").runs;
    };
    EXPECT_THAT(read(table + rows), SizeIs(2));
    std::string other = rows;
    other.replace(other.find(",1,,"), 4, ",9,,");
    EXPECT_THROW((void)read(table + other), InputError);
}

TEST(MeasuredRuns, AreNarrowedByAnySetting) {
    MeasuredRuns runs =
        runsOf({{.ms = "1"}, {.ms = "2", .particles = 2000}, {.ms = "3", .particles = 2000, .depth = "9"}});
    narrow(runs, {{"--where", "particles", {"2e3"}}});
    EXPECT_THAT(runs.runs, SizeIs(2));
    narrow(runs, {{"--where", "size", {"320x240", "1x1"}}, {"--where", "depth", {"9"}}});
    EXPECT_THAT(runs.runs, SizeIs(1));
}

std::string refusal(const Condition& condition) {
    MeasuredRuns runs = runsOf({{.ms = "1"}, {.ms = "2", .particles = 2000}});
    try {
        narrow(runs, {condition});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(MeasuredRuns, SayWhichConditionNoRunMeets) {
    EXPECT_THAT(refusal({"--where", "particels", {"500"}}), HasSubstr("did you mean 'particles'?"));
    EXPECT_THAT(refusal({"--where", "particles", {"700"}}),
                HasSubstr("got particles=700, allowed: measured values: 2000, 500"));
    EXPECT_EQ(refusal({"--light", "light", {"sun"}}), "--light: got 'sun', but 'summary.csv' has no setting 'light'");
}

TEST(MeasuredRuns, AreNoneOfATableOfSomethingElse) {
    EXPECT_THROW((void)measuredRuns(files::CsvTable::parseText("a,b\n1,2\n", "x.csv"), "x.csv"), InputError);
    EXPECT_THROW((void)readMeasuredRuns("/nowhere"), InputError);
}

}  // namespace
}  // namespace dustbench::recommend
