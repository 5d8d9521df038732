#include "bench/results/run_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bench/results/temporary_folder.h"

namespace dustbench::bench {
namespace {

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
}  // namespace dustbench::bench
