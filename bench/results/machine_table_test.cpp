#include "bench/results/machine_table.h"

#include <gtest/gtest.h>

#include <fstream>

#include "bench/results/summary_runs.h"
#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

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

}  // namespace
}  // namespace dustbench::bench
