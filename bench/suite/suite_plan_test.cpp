#include "bench/suite/suite_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/results/compared_runs.h"
#include "bench/suite/side_by_side.h"
#include "bench/suite/suite_cells.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::suite {
namespace {

constexpr const char* timed = R"(
methods = ["billboard"]
drives = ["straight", "slalom"]
sizes = ["64x48", "128x96"]
seed = [3, 7]
repetitions = 3
images = 2
metrics = true
volumes = "0:10:5"
[parameters]
particles = [100, 200]
sort = ["none", "radix"]
)";

class Baselines : public testing::Test {
 protected:
    void SetUp() override {
        for (const std::string_view id : {std::string_view("billboard"), results::baselineMethod})
            if (std::ranges::none_of(methods(), [&](const MethodInfo& info) { return info.id == id; }))
                GTEST_SKIP() << "no " << id << " here";
    }
    static Suite parsed(const std::string& text) { return parseSuite(text, "s", false); }
    static std::vector<PlannedRun> addedTo(const Suite& suite) {
        std::vector<PlannedRun> cells = withBaselines(suite).cells;
        cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(suite.cells.size()));
        return cells;
    }
    static bool isBaseline(const PlannedRun& run) { return run.spec.method == results::baselineMethod; }
};

TEST_F(Baselines, RunOnceInEveryWorldWhateverTheMethodsSettings) {
    const Suite suite = parsed(timed);
    const std::vector<PlannedRun> added = addedTo(suite);
    EXPECT_EQ(added.size(), 2u * 2u * 2u * 2u);  // drives, sizes, seeds, loads
    std::set<std::string> worlds, theirs;
    for (const PlannedRun& cell : suite.cells) worlds.insert(worldKey(cell.spec));
    for (const PlannedRun& cell : added) {
        EXPECT_TRUE(theirs.insert(worldKey(cell.spec)).second) << cell.label;
        EXPECT_EQ(cell.spec.method, results::baselineMethod);
        EXPECT_FALSE(cell.spec.metricPlan);
        EXPECT_FALSE(cell.spec.volumes);
        EXPECT_EQ(cell.spec.imagesEvery, 0);
        EXPECT_EQ(cell.spec.frames, suite.cells.front().spec.frames);
        EXPECT_EQ(cell.spec.parameters.count("sort"), 0u);
    }
    EXPECT_EQ(theirs, worlds);
    EXPECT_EQ(added.front().label, "drive=straight size=64x48 seed=3 particles=100");
}

TEST_F(Baselines, RunInEveryRoundBesideTheirWorld) {
    const Suite suite = parsed(timed);
    std::map<std::pair<std::string, int>, int> methodRuns, baselineRuns;
    const std::vector<PlannedRun> plan = planRuns(suite);
    EXPECT_EQ(plan.size(), (32u + 16u) * 3u);
    for (const PlannedRun& run : plan)
        ++(isBaseline(run) ? baselineRuns : methodRuns)[{worldKey(run.spec), run.spec.repetition}];
    ASSERT_EQ(baselineRuns.size(), methodRuns.size());
    for (const auto& [world, runs] : methodRuns) EXPECT_EQ(baselineRuns[world], 1);
    // The three runs of a world are adjacent and alternate in order.
    std::set<std::size_t> places;
    for (std::size_t i = 0; i < plan.size(); i += 3)
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_EQ(worldKey(plan[i + j].spec), worldKey(plan[i].spec)) << i;
            if (isBaseline(plan[i + j])) places.insert(j);
        }
    EXPECT_EQ(places.size(), 3u);
}

TEST_F(Baselines, AreLeftOutWhereNoTimeIsAskedFor) {
    const std::string one = "methods = [\"billboard\"]\nmetrics = true\n";
    EXPECT_TRUE(addedTo(parsed(one)).empty());
    EXPECT_EQ(addedTo(parsed(one + "baseline = true\n")).size(), 1u);
    EXPECT_EQ(addedTo(parsed(one + "repetitions = 2\n")).size(), 1u);
    EXPECT_TRUE(addedTo(parsed(one + "repetitions = 2\nbaseline = false\n")).empty());
    EXPECT_EQ(addedTo(parsed(one + "[parameters]\nparticles = [1, 2]\n[[fit]]\nagainst = \"particles\"\n"
                                   "columns = [\"frame_ms_median\"]\n"))
                  .size(),
              2u);
    // A quick run uses its own number of repetitions.
    EXPECT_FALSE(parseSuite(one + "repetitions = 2\n[quick]\nrepetitions = 1\n", "s", true).baseline);
    EXPECT_THAT(inputError([&] { (void)parsed(one + "baseline = 1\n"); }), testing::HasSubstr("baseline"));
}

TEST_F(Baselines, AreNotAddedWhereTheSuiteHasThem) {
    const std::string text =
        "methods = [\"null_method\", \"billboard\"]\nrepetitions = 6\n[parameters]\nspeed = [5, 9]\n";
    EXPECT_TRUE(addedTo(parsed(text)).empty());
    EXPECT_EQ(addedTo(parsed(text + "[method.null_method]\nwork = 5\n")).size(), 2u);
    EXPECT_EQ(addedTo(parsed(text + "[method.null_method]\nspeed = 5\n")).size(), 1u);
    EXPECT_TRUE(addedTo(parsed("methods = [\"null_method\"]\nrepetitions = 6\n[parameters]\nwork = [1, 2]\n")).empty());
}

TEST_F(Baselines, RepeatAsOftenAsTheMostRepeatedCellOfTheirWorld) {
    const std::string text =
        "methods = [\"billboard\"]\nrepetitions = 5\n[parameters]\nspeed = [5, 9]\nsort = [\"none\", \"radix\"]\n"
        "[[except]]\nafter_repetition = 2\n[except.parameters]\nspeed = 5\n"
        "[[except]]\nafter_repetition = 1\n[except.parameters]\nsort = \"none\"\n";
    std::map<std::string, int> runs;
    for (const PlannedRun& run : planRuns(parsed(text)))
        if (isBaseline(run)) ++runs[run.spec.parameters.at("speed")];
    EXPECT_EQ(runs, (std::map<std::string, int>{{"5", 2}, {"9", 5}}));
}

TEST_F(Baselines, StayInTheShardOfTheirWorld) {
    const Suite suite = parsed(timed);
    std::size_t runs = 0;
    for (int index = 1; index <= 4; ++index) {
        std::map<std::string, int> methodRuns, baselineRuns;
        const std::vector<PlannedRun> plan = planRuns(suite, {index, 4});
        runs += plan.size();
        for (const PlannedRun& run : plan) ++(isBaseline(run) ? baselineRuns : methodRuns)[worldKey(run.spec)];
        EXPECT_EQ(methodRuns.size(), baselineRuns.size());
        for (const auto& [world, count] : baselineRuns) EXPECT_EQ(methodRuns.count(world), 1u) << world;
    }
    EXPECT_EQ(runs, planRuns(suite).size());
}

TEST_F(Baselines, RunOnceForMethodsSideBySide) {
    const Suite suite = sideBySideSuite({"billboard", "billboard:sort=none"}, {}, {}, 2);
    EXPECT_EQ(addedTo(suite).size(), 1u);
    EXPECT_THAT(suite.comparisons.at(0).columns, testing::ElementsAre("frame_ms_median", "method_ms_median"));
    const Suite withNull = sideBySideSuite({"null_method", "billboard"}, {}, {}, 2);
    EXPECT_TRUE(addedTo(withNull).empty());
    EXPECT_THAT(withNull.comparisons.at(0).columns, testing::ElementsAre("frame_ms_median"));
}

constexpr const char* methodsInWorlds = R"(
methods = ["billboard", "octree_search"]
sizes = ["64x48", "96x72"]
baseline = false
repetitions = 3
[parameters]
particles = [100, 200, 300]
speed = [5, 20]
[method.billboard]
sort = ["none", "radix"]
)";

std::vector<std::string> idsOf(const std::vector<PlannedRun>& plan) {
    std::vector<std::string> ids;
    ids.reserve(plan.size());
    for (const PlannedRun& run : plan) ids.push_back(results::runId(run.spec));
    return ids;
}

TEST(Shard, TogetherTheyAreThePlanAndNoRunIsInTwo) {
    const Suite suite = parseSuite(methodsInWorlds, "s", false);
    const std::vector<std::string> whole = idsOf(planRuns(suite));
    ASSERT_EQ(whole.size(), 12u * 3 * 3);
    for (const int count : {1, 2, 3, 5, 12, 40}) {
        std::vector<std::string> together;
        for (int index = 1; index <= count; ++index)
            for (std::string& id : idsOf(planRuns(suite, {index, count}))) together.push_back(std::move(id));
        EXPECT_EQ(together.size(), whole.size());
        EXPECT_EQ(std::set<std::string>(together.begin(), together.end()),
                  std::set<std::string>(whole.begin(), whole.end()));
    }
}

TEST(Shard, KeepsTheOrderOfThePlanAndAWorldInOnePiece) {
    const Suite suite = parseSuite(methodsInWorlds, "s", false);
    const std::vector<std::string> whole = idsOf(planRuns(suite));
    std::map<std::string, std::set<int>> shardsOfWorld;
    for (int index = 1; index <= 5; ++index) {
        const std::vector<PlannedRun> plan = planRuns(suite, {index, 5});
        std::vector<std::string> expected = idsOf(plan), found;
        std::ranges::copy_if(whole, std::back_inserter(found),
                             [&](const std::string& id) { return std::ranges::find(expected, id) != expected.end(); });
        EXPECT_EQ(found, expected);
        for (const PlannedRun& run : plan)
            shardsOfWorld[run.spec.parameters.at("particles") + " " + run.spec.parameters.at("speed") + " " +
                          std::to_string(run.spec.size.width)]
                .insert(index);
        // Twelve worlds of nine runs: two or three per shard.
        EXPECT_TRUE(plan.size() == 18 || plan.size() == 27) << plan.size();
    }
    EXPECT_EQ(shardsOfWorld.size(), 12u);
    for (const auto& [world, shards] : shardsOfWorld) EXPECT_EQ(shards.size(), 1u) << world;
}

TEST(Shard, WorldsThatAreComparedStayTogether) {
    const Suite suite = parseSuite(R"(
methods = ["billboard"]
[parameters]
particles = [100, 200, 300, 400]
speed = [5, 20]
[[compare]]
of = "billboard particles=100"
with = "billboard particles=400"
columns = ["frame_ms_median"]
)",
                                   "s", false);
    const std::vector<int> shards = shardOfCells(suite, 6);
    std::map<std::string, int> shardOf;
    for (std::size_t i = 0; i < suite.cells.size(); ++i) {
        const results::ParameterTexts& parameters = suite.cells[i].spec.parameters;
        shardOf[parameters.at("particles") + " " + parameters.at("speed")] = shards[i];
    }
    EXPECT_EQ(shardOf["100 5"], shardOf["400 5"]);
    EXPECT_EQ(shardOf["100 20"], shardOf["400 20"]);
    std::set<int> used;
    for (const auto& [world, shard] : shardOf) used.insert(shard);
    EXPECT_EQ(used.size(), 6u);
}

TEST(Shard, NeitherTheOrderNorTheRepetitionsMoveACell) {
    Suite suite = parseSuite(methodsInWorlds, "s", false);
    const std::vector<int> shards = shardOfCells(suite, 4);
    suite.order = Order::batch;
    suite.repetitions = 7;
    EXPECT_EQ(shardOfCells(suite, 4), shards);
}

TEST(Shard, IsReadFromItsText) {
    const Shard shard = parseShard("2/3");
    EXPECT_EQ(shard.index, 2);
    EXPECT_EQ(shard.count, 3);
    for (const char* text : {"0/3", "4/3", "x", "", "1", "1/", "/3", "1/3x", "-1/3", "1/0", "1/10001", "1 /3"})
        EXPECT_THROW((void)parseShard(text), InputError) << text;
}

}  // namespace
}  // namespace dustbench::suite
