#include "bench/suite/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

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
    for (const PlannedRun& run : plan) ids.push_back(runId(run.spec));
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
        const ParameterTexts& parameters = suite.cells[i].spec.parameters;
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
}  // namespace dustbench::bench
