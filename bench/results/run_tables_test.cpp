#include "bench/results/run_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"

namespace dustbench::results {
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

StoredRun runOf(const std::string& started, RunStatus status = RunStatus::done) {
    StoredRun run;
    run.runId = started;
    run.status = status;
    run.cells = {{"run_id", started}, {"status", "done"}, {"repetition", "1"}};
    run.provenance = {{"cpu", "a \"CPU\", fast"}, {"started_utc", started}, {"key", "method=haze"}};
    return run;
}

TEST(MachineTable, IsThatOfTheFirstRunAndReadBackWithTheTables) {
    const StoredRuns runs{
        {"a", runOf("2026-03-02")}, {"b", runOf("2026-03-01")}, {"c", runOf("2026-02-01", RunStatus::skipped)}};
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "machine.csv") << machineCsv(runs);
    std::ofstream(folder.path() / "summary.csv") << "run_id,status,reason,repetition\na,done,,1\n";
    std::vector<std::string> problems;
    const StoredRuns read = readSummaryRuns(folder.path(), problems);
    EXPECT_TRUE(problems.empty());
    EXPECT_EQ(read.at("a").provenance.at("started_utc"), "2026-03-01");
    EXPECT_EQ(read.at("a").provenance.at("cpu"), "a \"CPU\", fast");
    EXPECT_FALSE(read.at("a").provenance.contains("key"));
}

TEST(MachineTable, NeedsARunThatIsDone) {
    EXPECT_THROW((void)machineCsv({{"c", runOf("2026-02-01", RunStatus::failed)}}), InputError);
}

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

StoredRuns someRuns() {
    StoredRun steady, slowed;
    steady.runId = "a";
    slowed.runId = "b";
    steady.stateHash = "0123";
    steady.provenance["key"] = "method=haze\nscene=plain, \"dusk\"\n";
    slowed.methodHash = "4567";
    slowed.warnings = {"clock fell: the GPU's from 1800 to 900 MHz", "the machine is busy, very"};
    return {{"a", steady}, {"b", slowed}};
}

TEST(RunTable, IsReadBack) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "runs.csv") << runsCsv(someRuns());
    StoredRuns read{{"a", {}}, {"b", {}}, {"c", {}}};
    std::vector<std::string> problems;
    addRunTable(folder.path(), read, problems);
    EXPECT_THAT(problems, IsEmpty());
    EXPECT_EQ(read.at("a").provenance.at("key"), "method=haze\nscene=plain, \"dusk\"\n");
    EXPECT_EQ(read.at("a").stateHash, "0123");
    EXPECT_THAT(read.at("a").warnings, IsEmpty());
    EXPECT_EQ(read.at("b").methodHash, "4567");
    EXPECT_EQ(read.at("b").warnings, someRuns().at("b").warnings);
    EXPECT_THAT(read.at("c").provenance, IsEmpty());
}

TEST(RunTable, MayBeMissingOrDamaged) {
    const TemporaryFolder folder;
    StoredRuns read{{"a", {}}};
    std::vector<std::string> problems;
    addRunTable(folder.path(), read, problems);
    EXPECT_THAT(problems, IsEmpty());
    std::ofstream(folder.path() / "runs.csv") << "run_id,key\na,\"method";
    addRunTable(folder.path(), read, problems);
    EXPECT_THAT(problems, ElementsAre(HasSubstr("runs.csv")));
    EXPECT_THAT(read.at("a").provenance, IsEmpty());
}

}  // namespace
}  // namespace dustbench::results
