#include "bench/suite/bundle/bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "methods/kit/testing/test_input_error.h"

namespace dustbench::suite {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

results::StoredRun runOf(const results::RunSpec& spec, const std::string& stateHash,
                         const std::string& methodHash = "") {
    results::StoredRun run;
    run.runId = results::runId(spec);
    run.stateHash = stateHash;
    run.methodHash = methodHash;
    run.provenance["key"] = results::canonicalKey(spec);
    return run;
}

results::RunSpec spec() {
    results::RunSpec spec;
    spec.method = "billboard";
    spec.scene = "mine.toml";
    spec.drive = "straight";
    spec.cameraPath = "path.csv";
    spec.parameters = {{"particles", "100"}, {"sort", "radix"}};
    spec.frames = 7;
    spec.warmup = 3;
    spec.size = {64, 48};
    spec.seed = 18446744073709551615U;
    return spec;
}

results::StoredRuns stored(const std::vector<results::StoredRun>& list) {
    results::StoredRuns runs;
    for (const results::StoredRun& run : list) runs.emplace(run.runId, run);
    return runs;
}

TEST(ExactRuns, TheSpecificationIsReadBack) {
    const auto exact = exactRuns(stored({runOf(spec(), "1", "2")}));
    ASSERT_THAT(exact, SizeIs(1));
    EXPECT_EQ(results::canonicalKey(exact[0].spec), results::canonicalKey(spec()));
    EXPECT_EQ(exact[0].stateHash, "1");
    EXPECT_EQ(exact[0].methodHash, "2");
}

/// The last bits of dust on a GPU may differ: the repetition is where the recorded run was.
TEST(ExactRuns, DustIsRepeatedWhereItWas) {
    for (const char* place : {"cpu", "gpu"}) {
        results::StoredRun run = runOf(spec(), "1");
        run.provenance["dust_on"] = place;
        const auto exact = exactRuns(stored({run}));
        ASSERT_THAT(exact, SizeIs(1));
        EXPECT_EQ(exact[0].spec.dustOn == results::DustOn::gpu, std::string(place) == "gpu");
    }
}

TEST(ExactRuns, WhatSimulatesTheSameIsOne) {
    std::vector<results::StoredRun> list;
    results::RunSpec same = spec();
    for (same.repetition = 1; same.repetition < 4; ++same.repetition) list.push_back(runOf(same, "1"));
    same = spec();
    same.threads = 3;
    same.imagesEvery = 2;
    same.sync = results::Sync::stage;
    same.metricPlan = reference::MetricPlan();
    list.push_back(runOf(same, "1"));
    const auto exact = exactRuns(stored(list));
    ASSERT_THAT(exact, SizeIs(1));
    EXPECT_THAT(exact[0].runIds, SizeIs(4));
    EXPECT_EQ(results::canonicalKey(exact[0].spec), results::canonicalKey(spec()));
}

TEST(ExactRuns, WhatSimulatesSomethingElseIsNot) {
    std::vector<results::StoredRun> list{runOf(spec(), "1")};
    const auto add = [&](auto change) {
        results::RunSpec other = spec();
        change(other);
        list.push_back(runOf(other, std::to_string(list.size() + 1)));
    };
    add([](results::RunSpec& run) { run.method = "relief"; });
    add([](results::RunSpec& run) { run.scene = "plain"; });
    add([](results::RunSpec& run) { run.drive = ""; });
    add([](results::RunSpec& run) { run.cameraPath = ""; });
    add([](results::RunSpec& run) { run.parameters["particles"] = "101"; });
    add([](results::RunSpec& run) { run.frames = 8; });
    add([](results::RunSpec& run) { run.warmup = 4; });
    add([](results::RunSpec& run) { run.seed = 2; });
    EXPECT_THAT(exactRuns(stored(list)), SizeIs(list.size()));
}

TEST(ExactRuns, RunsThatDidNotEndHaveNothingExact) {
    results::StoredRun failed = runOf(spec(), "1"), without = runOf(spec(), "");
    failed.status = results::RunStatus::failed;
    EXPECT_THAT(exactRuns(stored({failed})), testing::IsEmpty());
    EXPECT_THAT(exactRuns(stored({without})), testing::IsEmpty());
}

TEST(ExactRuns, TwoHashesOfOneSimulationAreRefused) {
    results::RunSpec second = spec();
    second.repetition = 2;
    EXPECT_THAT(inputError([&] {
                    (void)exactRuns(stored({runOf(spec(), "1", "3"), runOf(second, "1", "4")}));
                }),
                HasSubstr("of the same simulation"));
}

TEST(ExactRuns, ADifferenceNamesBothHashes) {
    const ExactRun expected{{"a"}, "1", "2", spec()};
    EXPECT_EQ(hashDifference(runOf(spec(), "1", "2"), expected), "");
    EXPECT_EQ(hashDifference(runOf(spec(), "3", ""), expected),
              "state_hash is 3, expected 1; method_hash is none, expected 2");
}

}  // namespace
}  // namespace dustbench::suite
