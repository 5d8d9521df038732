#include "bench/report/older_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/suite/suite.h"

namespace dustbench::report {
namespace {

/// The row of a planned run in summary.csv, with an id of another build.
results::StoredRun rowOf(const results::RunSpec& spec) {
    results::StoredRun run;
    run.runId = "of-an-older-build";
    run.cells = {{"method", spec.method},
                 {"scene", spec.scene},
                 {"width", std::to_string(spec.size.width)},
                 {"height", std::to_string(spec.size.height)},
                 {"seed", std::to_string(spec.seed)},
                 {"repetition", std::to_string(spec.repetition)},
                 {"frames", std::to_string(spec.frames)},
                 {"sync", "frame"}};
    for (const auto& [name, value] : spec.parameters)
        if (!value.empty()) run.parameters[name] = value;
    return run;
}

/// The id that the row gets.
std::string adopted(const results::StoredRun& row) {
    results::StoredRuns runs{{row.runId, row}};
    std::vector<std::string> problems;
    adoptOlderRows(runs, problems);
    EXPECT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs.begin()->first, runs.begin()->second.runId);
    EXPECT_EQ(problems.empty(), runs.begin()->first == row.runId);
    return runs.begin()->first;
}

TEST(OlderRows, AParameterThatWasAddedSinceIsAtItsDefault) {
    const results::RunSpec spec = suite::inRepetition(suite::loadSuite("carr2006-depth", true).cells.front().spec, 1);
    results::StoredRun row = rowOf(spec);
    ASSERT_EQ(spec.parameters.at("sort"), "quicksort");
    EXPECT_EQ(adopted(row), row.runId) << "it lacks nothing: what differs is not said";
    row.parameters.erase("crossfade");
    EXPECT_EQ(adopted(row), results::runId(spec));

    results::StoredRun other = row;
    other.parameters["depth"] = "9";
    EXPECT_EQ(adopted(other), row.runId) << "no suite has it";
    other = row;
    other.parameters.erase("sort");
    EXPECT_EQ(adopted(other), row.runId) << "the suite sorts otherwise than by default";
    other = row;
    other.parameters["gone"] = "1";
    EXPECT_EQ(adopted(other), row.runId) << "a parameter that no longer exists";
    other = row;
    other.cells["frames"] = "7";
    EXPECT_EQ(adopted(other), row.runId);
}

TEST(OlderRows, ARunThatIsThereKeepsItsPlace) {
    const results::RunSpec spec = suite::inRepetition(suite::loadSuite("carr2006-depth", true).cells.front().spec, 1);
    results::StoredRun older = rowOf(spec), own = older;
    older.parameters.erase("crossfade");
    own.runId = results::runId(spec);
    results::StoredRuns runs{{older.runId, older}, {own.runId, own}};
    std::vector<std::string> problems;
    adoptOlderRows(runs, problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_TRUE(runs.contains(older.runId));
    EXPECT_TRUE(runs.at(own.runId).parameters.contains("crossfade"));
}

}  // namespace
}  // namespace dustbench::report
