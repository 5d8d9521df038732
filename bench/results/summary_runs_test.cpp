#include "bench/results/summary_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;

void writeTable(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

TEST(SummaryRuns, AreTheRowsWithTheMachineOfTheTableBesideThem) {
    const TemporaryFolder folder;
    EXPECT_FALSE(holdsTablesAlone(folder.path()));
    writeTable(folder.path() / "summary.csv",
               "run_id,status,reason,method,repetition,p.particles,p.sort,fps_avg\n"
               "a,done,,haze,1,100,,30\nb,failed,it rained,haze,2,200,radix,\n");
    writeTable(folder.path() / "machine.csv", "cpu,cores\nA PC,2\n");
    EXPECT_TRUE(holdsTablesAlone(folder.path()));
    std::vector<std::string> problems;
    const StoredRuns runs = readSummaryRuns(folder.path(), problems);
    EXPECT_TRUE(problems.empty());
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs.at("a").parameters, (ParameterTexts{{"particles", "100"}})) << "an empty cell is not a parameter";
    EXPECT_EQ(runs.at("a").cells.at("fps_avg"), "30");
    EXPECT_FALSE(runs.at("a").cells.contains("p.particles"));
    EXPECT_EQ(runs.at("a").provenance.at("cpu"), "A PC");
    EXPECT_EQ(runs.at("b").status, RunStatus::failed);
    EXPECT_EQ(runs.at("b").reason, "it rained");
    std::filesystem::create_directory(folder.path() / "runs");
    EXPECT_FALSE(holdsTablesAlone(folder.path()));
}

TEST(SummaryRuns, ADamagedRowIsLeftOutAndNamed) {
    const TemporaryFolder folder;
    writeTable(folder.path() / "summary.csv",
               "run_id,status,reason,method,repetition,fps_avg\n"
               "a,done,,haze,1,30\na,done,,haze,1,31\nb,finished,,haze,1,30\nc,done,,haze,1,fast\nd,done,,haze,0,30\n"
               ",done,,haze,1,30\n");
    std::vector<std::string> problems;
    const StoredRuns runs = readSummaryRuns(folder.path(), problems);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs.at("a").cells.at("fps_avg"), "30");
    ASSERT_EQ(problems.size(), 5u);
    EXPECT_THAT(problems[0], AllOf(HasSubstr("summary.csv:3"), HasSubstr("appears twice")));
    EXPECT_THAT(problems[1], AllOf(HasSubstr("summary.csv:4"), HasSubstr("finished")));
    EXPECT_THAT(problems[2], AllOf(HasSubstr("summary.csv:5"), HasSubstr("'fast'")));
    EXPECT_THAT(problems[3], AllOf(HasSubstr("summary.csv:6"), HasSubstr("repetition")));
    EXPECT_THAT(problems[4], HasSubstr("summary.csv:7"));
}

}  // namespace
}  // namespace dustbench::bench
