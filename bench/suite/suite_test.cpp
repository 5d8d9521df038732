#include "bench/suite/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/measure/statistics.h"
#include "bench/results/run_record.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::suite {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* sweep = R"(
title = "Sweep"
methods = ["billboard"]
scenes = ["plain"]
drives = ["straight", "slalom"]
sizes = ["64x48", "128x96", "256x192"]
repetitions = 4
baseline = false
frames = 50
seed = 9

[parameters]
particles = [100, "200:400:100"]
speed = "10,20"

[quick]
repetitions = 2
frames = 5
sizes = ["64x48"]
[quick.parameters]
particles = 50
)";

std::string messageOf(const std::string& text) {
    try {
        (void)parseSuite(text, "s.toml", false);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing thrown";
}

std::vector<std::string> ids(const std::vector<PlannedRun>& plan) {
    std::vector<std::string> list;
    list.reserve(plan.size());
    for (const PlannedRun& run : plan) list.push_back(results::runId(run.spec));
    return list;
}

TEST(Suite, IsTheProductOfItsLists) {
    const Suite suite = parseSuite(sweep, "sweep", false);
    EXPECT_EQ(suite.cells.size(), 2u * 3u * 4u * 2u);
    const auto plan = planRuns(suite);
    EXPECT_EQ(plan.size(), suite.cells.size() * 4);
    const auto list = ids(plan);
    EXPECT_EQ(std::set<std::string>(list.begin(), list.end()).size(), plan.size());
}

TEST(Suite, OfSeveralSeedsHasAWorldForEach) {
    const std::string text = "methods = [\"null_method\", \"billboard\"]\nseed = [1, 5, 9]\n";
    const Suite suite = parseSuite(text, "seeds", false);
    ASSERT_EQ(suite.cells.size(), 6u);
    std::set<std::uint64_t> seeds;
    for (const PlannedRun& cell : suite.cells) {
        seeds.insert(cell.spec.seed);
        EXPECT_THAT(cell.label, HasSubstr("seed=" + std::to_string(cell.spec.seed)));
    }
    EXPECT_EQ(seeds, (std::set<std::uint64_t>{1, 5, 9}));
    EXPECT_THAT(messageOf("seed = [1, 1]"), HasSubstr("1 is given twice"));
    EXPECT_THAT(messageOf("seed = []"), HasSubstr("empty array"));
    EXPECT_THAT(messageOf("seed = -1"), HasSubstr("got -1, expected an integer of 0 or more"));
    EXPECT_THAT(messageOf("seed = 1.5"), HasSubstr("got 1.5"));
}

TEST(Suite, QuickTakesTheValuesOfItsTableAndKeepsTheRest) {
    const Suite suite = parseSuite(sweep, "sweep", true);
    EXPECT_EQ(suite.cells.size(), 2u * 1u * 1u * 2u);
    EXPECT_EQ(suite.repetitions, 2);
    for (const PlannedRun& cell : suite.cells) {
        EXPECT_EQ(cell.spec.frames, 5);
        EXPECT_EQ(cell.spec.seed, 9u);
        EXPECT_EQ(cell.spec.parameters.at("particles"), "50");
    }
}

TEST(Suite, InterleavedRoundsHoldEveryCellOnceInSeededOrder) {
    const Suite suite = parseSuite(sweep, "sweep", false);
    const auto plan = planRuns(suite);
    const std::size_t cells = suite.cells.size();
    std::vector<std::vector<std::string>> rounds;
    for (int round = 0; round < suite.repetitions; ++round) {
        std::vector<std::string> keys;
        for (std::size_t i = 0; i < cells; ++i) {
            results::RunSpec spec = plan[static_cast<std::size_t>(round) * cells + i].spec;
            EXPECT_EQ(spec.repetition, round + 1);
            spec.repetition = 1;
            keys.push_back(results::runId(spec));
        }
        EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), cells);
        rounds.push_back(keys);
    }
    EXPECT_NE(rounds[0], rounds[1]);
    EXPECT_NE(rounds[0], ids(suite.cells));
    EXPECT_EQ(ids(plan), ids(planRuns(suite)));

    Suite otherSeed = suite;
    for (PlannedRun& cell : otherSeed.cells) cell.spec.seed = 10;
    const auto other = planRuns(otherSeed);
    const auto label = [](const PlannedRun& run) { return run.label; };
    std::vector<std::string> labels, otherLabels;
    std::ranges::transform(plan, std::back_inserter(labels), label);
    std::ranges::transform(other, std::back_inserter(otherLabels), label);
    EXPECT_NE(labels, otherLabels);
}

TEST(Suite, WhatIsComparedStandsSideBySideInEveryRoundAndTakesTurnsToBeFirst) {
    const Suite suite = parseSuite(R"(
methods = ["null_method"]
scenes = ["plain"]
drives = ["straight"]
sizes = ["64x48"]
repetitions = 6
[parameters]
speed = "1:5:1"
entry = ["first", "second"]
)",
                                   "turns", false);
    const auto plan = planRuns(suite);
    ASSERT_EQ(plan.size(), 60u);
    std::set<std::string> worlds, earlier;
    for (std::size_t i = 0; i < plan.size(); i += 2) {
        const results::ParameterTexts &a = plan[i].spec.parameters, &b = plan[i + 1].spec.parameters;
        EXPECT_EQ(a.at("speed"), b.at("speed")) << i;
        EXPECT_NE(a.at("entry"), b.at("entry")) << i;
        if (i < 10) worlds.insert(a.at("speed"));
        earlier.insert(a.at("entry"));
    }
    EXPECT_EQ(worlds.size(), 5u);
    EXPECT_EQ(earlier.size(), 2u);
}

TEST(Suite, BatchOrderKeepsTheRepetitionsOfACellTogether) {
    Suite suite = parseSuite(sweep, "sweep", false);
    suite.order = Order::batch;
    const auto plan = planRuns(suite);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        EXPECT_EQ(plan[i].spec.repetition, static_cast<int>(i % 4) + 1);
        EXPECT_EQ(plan[i].label, suite.cells[i / 4].label);
    }
}

TEST(Suite, EveryMethodOfTheBuildTakesPartWhereAllAre) {
    const Suite suite = parseSuite("methods = \"all\"", "all", false);
    EXPECT_EQ(suite.cells.size(), methods().size());
    // Many CSV readers would treat such a name as a missing value.
    for (const MethodInfo& method : methods())
        EXPECT_THAT(method.id, testing::Not(testing::AnyOf("null", "none", "nan", "na", "n_a"))) << method.id;
}

TEST(Suite, ExceptionsLeaveOutTheCellsThatHaveAllTheirValues) {
    const std::string text =
        "methods = [\"null_method\"]\ndrives = [\"straight\", \"slalom\"]\n[parameters]\nwork = [0, 1, 2]\nspeed = [5, "
        "10]\n"
        "[[except]]\ndrives = [\"slalom\"]\n[except.parameters]\nwork = [1, 2.0]\n[[except]]\n[except.parameters]\n"
        "speed = \"10\"\nwork = 0\n[quick]\ndrives = [\"straight\"]\n";
    const Suite suite = parseSuite(text, "s.toml", false);
    EXPECT_EQ(suite.cells.size(), 2u * 3u * 2u - 4u - 2u);
    for (const PlannedRun& cell : suite.cells) {
        const auto& parameters = cell.spec.parameters;
        EXPECT_FALSE(cell.spec.drive == "slalom" && parameters.at("work") != "0");
        EXPECT_FALSE(parameters.at("speed") == "10" && parameters.at("work") == "0");
    }
    EXPECT_EQ(parseSuite(text, "s.toml", true).cells.size(), 6u - 1u);
    EXPECT_THAT(messageOf("[[except]]\nmethods = [\"null_methd\"]"),
                AllOf(HasSubstr("s.toml:2"), HasSubstr("'null_method'")));
    EXPECT_THAT(messageOf("\n[[except]]\n[except.parameters]\nwrok = 1"),
                AllOf(HasSubstr("s.toml:2"), HasSubstr("except: matches no configuration")));
    EXPECT_THAT(messageOf("[[except]]\n[except.parameters]\nspeed = 0"), HasSubstr("exclude every configuration"));
}

TEST(Suite, ExceptionsWithAReasonStayInThePlanAsSkipped) {
    const std::string text =
        "methods = [\"null_method\"]\nrepetitions = 3\n[parameters]\nwork = [0, 1]\n"
        "[[except]]\nreason = \"too much work\"\n[except.parameters]\nwork = 1\n";
    int others = 0, skipped = 0;
    for (const PlannedRun& run : planRuns(parseSuite(text, "s.toml", false))) {
        const bool isLeftOut = run.spec.parameters.at("work") == "1";
        EXPECT_EQ(run.skip, isLeftOut ? "too much work" : "");
        ++(isLeftOut ? skipped : others);
    }
    EXPECT_EQ(others, 3);
    EXPECT_EQ(skipped, 1);
    EXPECT_THAT(messageOf("[[except]]\nreason = \"all\"\n"), HasSubstr("exclude every configuration"));
    EXPECT_THAT(messageOf("[[except]]\nafter_repetition = 1\nreason = \"late\"\n"),
                AllOf(HasSubstr("s.toml:3"), HasSubstr("after_repetition")));
}

TEST(Suite, ExceptionsAfterARepetitionLeaveTheEarlierOnes) {
    for (const char* order : {"interleaved", "batch"}) {
        const Suite suite = parseSuite("methods = [\"null_method\"]\nrepetitions = 3\norder = \"" + std::string(order) +
                                           "\"\n[parameters]\nwork = [0, 1]\n"
                                           "[[except]]\nafter_repetition = 1\n[except.parameters]\nwork = 1\n",
                                       "s.toml", false);
        EXPECT_EQ(suite.cells.size(), 2u);
        int others = 0;
        std::vector<int> repetitions;
        for (const PlannedRun& run : planRuns(suite))
            run.spec.parameters.at("work") == "1" ? repetitions.push_back(run.spec.repetition) : void(++others);
        EXPECT_EQ(others, 3);
        EXPECT_THAT(repetitions, testing::ElementsAre(1));
    }
    EXPECT_THAT(messageOf("[[except]]\nafter_repetition = -1"), HasSubstr("after_repetition"));
}

TEST(Suite, MistakesNameFileLineAndWhatIsNear) {
    EXPECT_THAT(messageOf("methods = [\n\"bilboard\"]"), AllOf(HasSubstr("s.toml:1"), HasSubstr("'billboard'")));
    EXPECT_THAT(messageOf("frames = 5\nscenes = [\"plainn\"]"), AllOf(HasSubstr("s.toml:2"), HasSubstr("'plain'")));
    EXPECT_THAT(messageOf("repetition = 5"), AllOf(HasSubstr("s.toml:1"), HasSubstr("repetitions")));
    EXPECT_THAT(messageOf("[parameters]\n\nparticle = 5"), AllOf(HasSubstr("s.toml:3"), HasSubstr("'particles'")));
    EXPECT_THAT(messageOf("[parameters]\nparticles = -5"), AllOf(HasSubstr("s.toml:2"), HasSubstr("-5")));
    EXPECT_THAT(messageOf("[parameters]\nparticles = \"1:2\""), HasSubstr("s.toml:2"));
    EXPECT_THAT(messageOf("sizes = [\"64\"]"), AllOf(HasSubstr("s.toml:1"), HasSubstr("WIDTHxHEIGHT")));
    EXPECT_THAT(messageOf("[quick]\nframe = 5"), AllOf(HasSubstr("s.toml:2"), HasSubstr("frames")));
    EXPECT_THAT(messageOf("[method.billbord]\nsort = \"none\""), HasSubstr("'billboard'"));
}

TEST(Suite, ItsRunsAreCountedBeforeTheyAreMade) {
    const std::string loads = "[parameters]\nparticles = \"1:10000:1\"\n";
    EXPECT_THAT(messageOf("methods = [\"null_method\"]\nrepetitions = 1000\n" + loads),
                HasSubstr("got 10000000 planned runs, allowed: 100000 (limit of a command)"));
    EXPECT_THAT(messageOf("methods = [\"null_method\"]\n" + loads + "speed = \"0.001:10:0.001\"\n"),
                HasSubstr("got 100000000 planned runs, allowed: 100000"));
    EXPECT_THAT(messageOf("methods = [\"null_method\"]\nrepetitions = 1001\n"), HasSubstr("1..1000"));
    const MethodInfo& method = findMethod("null_method");
    const std::vector<std::string> thousand(1000, "1");
    EXPECT_THROW((void)expandParameters(results::RunSpec(), method, {{"particles", thousand}, {"speed", thousand}}),
                 InputError);
}

TEST(Suite, EverySuiteOfTheProjectCanBePlanned) {
    const auto suites = listSuites();
    EXPECT_FALSE(suites.empty());
    for (const SuiteFile& file : suites)
        for (const bool quick : {false, true}) {
            const Suite suite = loadSuite(file.id, quick);
            EXPECT_FALSE(planRuns(suite).empty()) << file.id;
            EXPECT_FALSE(suite.title.empty()) << file.id;
            if (suite.comparisons.empty()) continue;
            EXPECT_GE(suite.repetitions, static_cast<int>(measure::minimumPairs))
                << file.id << ": too few for a verdict";
            EXPECT_EQ(suite.order, Order::interleaved) << file.id;
        }
}

TEST(Suite, WithoutTimesRefusesWhatIsAboutThem) {
    const std::string text = "methods = [\"billboard\"]\ntimes = false\n", chart = "chart = \"gaps\"\n";
    const Suite suite = parseSuite(text + chart, "s.toml", false);
    EXPECT_FALSE(suite.cells.front().spec.timed);
    EXPECT_FALSE(suite.baseline);
    EXPECT_NE(results::runId(suite.cells.front().spec),
              results::runId(parseSuite(chart, "s.toml", false).cells.front().spec));
    EXPECT_THAT(messageOf(text), AllOf(HasSubstr("s.toml:2"), HasSubstr("'fps_avg'")));
    EXPECT_THAT(messageOf(text + "chart = \"frame_ms_p95\"\n"), HasSubstr("'frame_ms_p95'"));
    for (const char* more : {"repetitions = 2", "cooldown_s = 1", "baseline = true",
                             "[[fit]]\nagainst = \"particles\"\ncolumns = [\"frame_ms_median\"]\n[parameters]\n"
                             "particles = [10, 20, 40, 80]"})
        EXPECT_THAT(messageOf(text + chart + more), AllOf(HasSubstr("s.toml:2"), HasSubstr("'times': got false with")))
            << more;
    EXPECT_THAT(messageOf(chart + "methods = [\"billboard\"]\n[quick]\ntimes = false\nrepetitions = 2\n"),
                HasSubstr("s.toml:4"));
    Suite repeated = suite;
    repeated.repetitions = 3;  // as set by the command line
    EXPECT_THROW((void)planRuns(repeated), InputError);
}

TEST(Suite, SaysWhatItsChartOpensOn) {
    const std::string text = "methods = [\"billboard\"]\n[parameters]\nspeed = [10, 40]\n";
    const Suite plain = parseSuite(text, "s.toml", false);
    EXPECT_EQ(plain.chart.column, "");
    const Suite gaps = parseSuite("chart = \"gaps against speed\"\n" + text, "s.toml", false);
    EXPECT_EQ(gaps.chart.column, "gaps");
    EXPECT_EQ(gaps.chart.against, "speed");
    const Suite quick =
        parseSuite("chart = \"gaps\"\n" + text + "[quick]\nchart = \"flip against size\"\n", "s.toml", true);
    EXPECT_EQ(quick.chart.column, "flip");
    EXPECT_EQ(quick.chart.against, "size");
}

TEST(Suite, SaysWhereItsChartIsNamedWrongly) {
    const std::string text = "methods = [\"billboard\"]\n[parameters]\nspeed = [10, 40]\n";
    const auto of = [&text](const std::string& chart) { return messageOf("chart = \"" + chart + "\"\n" + text); };
    EXPECT_THAT(of("gap"), AllOf(HasSubstr("s.toml:1: "), HasSubstr("column for a chart 'gap'"), HasSubstr("gaps")));
    EXPECT_THAT(of("gaps against sped"),
                AllOf(HasSubstr("s.toml:1: "), HasSubstr("load of the chart 'sped'"), HasSubstr("speed")));
    EXPECT_THAT(of("FILE_image"), HasSubstr("column for a chart 'FILE_image'"));
    for (const char* wrong : {"", "gaps speed", "gaps against", "gaps over speed", "gaps against speed size"})
        EXPECT_THAT(of(wrong), HasSubstr("expected COLUMN or COLUMN against NAME")) << wrong;
    EXPECT_THAT(messageOf("chart = 3\n" + text), HasSubstr("s.toml:1: "));
}

TEST(Suite, AsksForVolumesOfEveryRun) {
    const char* text = R"(
methods = ["billboard"]
frames = 20
volumes = "0:20:10"
formats = ["vtp", "vti"]
resolution = 64
region = "0,0,0,1,2,3"
vdb_precision = "float"
[quick]
frames = 4
volumes = "0:4:2"
)";
    const Suite whole = parseSuite(text, "s.toml", false);
    ASSERT_TRUE(whole.cells.at(0).spec.volumes);
    const exports::VolumeSettings& volumes = *whole.cells.at(0).spec.volumes;
    EXPECT_EQ(volumes.frames.text(), "0:11:10");
    EXPECT_EQ(exports::formatsText(volumes.formats), "vti,vtp");
    EXPECT_EQ(volumes.resolution, 64);
    EXPECT_EQ(exports::regionText(volumes.region.value()), "0,0,0,1,2,3");
    EXPECT_EQ(volumes.option("vdb_precision"), "float");
    const Suite quick = parseSuite(text, "s.toml", true);
    EXPECT_EQ(quick.cells.at(0).spec.volumes.value().frames.last, 2);
    EXPECT_EQ(quick.cells.at(0).spec.volumes.value().resolution, 64);
    EXPECT_FALSE(parseSuite("methods = [\"billboard\"]", "s.toml", false).cells.at(0).spec.volumes);
}

TEST(Suite, SaysWhereVolumesAreAskedForWrongly) {
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"volumes = \"5:1\"", "reversed"},
        {"volumes = 5", "volumes"},
        {"volumes = \"0\"\nformats = [\"vtk\"]", "'vtk'"},
        {"volumes = \"0\"\nresolution = 4096", "2048"},
        {"volumes = \"0\"\nregion = \"0,0,0\"", "3 numbers"},
        {"volumes = \"0\"\nvdb_precision = \"double\"", "half|float"},
        {"formats = [\"vti\"]", "requires 'volumes'"},
    };
    for (const auto& [lines, expected] : mistakes)
        EXPECT_THAT(messageOf(lines), AllOf(HasSubstr("s.toml:"), HasSubstr(expected))) << lines;
    EXPECT_THAT(messageOf("frames = 4\nvolumes = \"4\""), HasSubstr("frame 4 is beyond"));
}

TEST(Suite, AsksForMetricsOfEachCellsFirstRepetition) {
    const Suite suite = parseSuite(R"(
methods = ["billboard"]
sizes = ["64x48"]
frames = 40
repetitions = 3
metrics = true
metric_frames = "0:40:8"
[metric_reference.billboard]
soft = true
)",
                                   "s", false);
    ASSERT_EQ(suite.cells.size(), 1u);
    int evaluated = 0;
    for (const PlannedRun& run : planRuns(suite)) {
        if (!run.spec.metricPlan) continue;
        ++evaluated;
        EXPECT_EQ(run.spec.repetition, 1);
        EXPECT_EQ(run.spec.metricPlan->moments->text(), "0:33:8");
        EXPECT_EQ(run.spec.metricPlan->referenceText(), "soft=on");
        const results::RunSpec again = results::specFromJson(results::specToJson(run.spec));
        EXPECT_EQ(results::runId(again), results::runId(run.spec));
    }
    EXPECT_EQ(evaluated, 1);
}

TEST(Suite, SaysWhereMetricsAreAskedForWrongly) {
    EXPECT_THAT(messageOf("metric_frames = \"0:40:8\""), AllOf(HasSubstr("s.toml:1"), HasSubstr("requires 'metrics")));
    EXPECT_THAT(messageOf("frames = 20\nmetrics = true\nmetric_frames = \"0:40:8\""),
                HasSubstr("beyond the run's end"));
    EXPECT_THAT(messageOf("metrics = true\nmetric_frames = \"0:4\""), HasSubstr("got 4 frames (0:4:1)"));
    EXPECT_THAT(messageOf("metrics = true\nmethods = [\"billboard\"]\n[metric_reference.bilboard]\nsoft = true"),
                HasSubstr("bilboard"));
    EXPECT_THAT(messageOf("metrics = true\nmethods = [\"billboard\"]\n[metric_reference.billboard]\nsofd = true"),
                AllOf(HasSubstr("s.toml:4"), HasSubstr("sofd")));
    EXPECT_THAT(
        messageOf(
            "metrics = true\nmethods = [\"billboard\"]\n[metric_reference.billboard]\nsort = [\"radix\", \"none\"]"),
        HasSubstr("got 2 values"));
}

}  // namespace
}  // namespace dustbench::suite
