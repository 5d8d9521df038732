// The rules of data/machines/README.md that the tables alone can show.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bench/measure/clock_watch.h"
#include "bench/results/run_tables.h"
#include "bench/results/temporary_folder.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::bench {
namespace {
namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A sentence for each broken rule.
std::vector<std::string> brokenRules(const fs::path& folder) {
    std::vector<std::string> broken, names;
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename());
        bytes += entry.file_size();
    }
    std::ranges::sort(names);
    if (names != std::vector<std::string>{"machine.csv", "runs.csv", "selfcheck.json", "summary.csv"})
        return {"holds other files than machine.csv, runs.csv, selfcheck.json and summary.csv"};
    if (bytes > 1'000'000) broken.emplace_back("is larger than 1 MB");
    if (files::wholeText(folder / "selfcheck.json", "a self-check").find("\"passed\": true") == std::string::npos)
        broken.emplace_back("the self-check failed");
    const auto machine = files::CsvTable::parseFile(folder / "machine.csv");
    if (machine.cell(0, "git_dirty") != "false") broken.emplace_back("the program had changes");
    if (machine.cell(0, "build_type") != "Release") broken.emplace_back("the program was no release build");
    std::vector<std::string> problems;
    std::size_t done = 0, unsteady = 0;
    for (const auto& [id, run] : readSummaryRuns(folder, problems)) {
        if (run.status == RunStatus::failed) broken.push_back("failed: " + id);
        if (run.status != RunStatus::done) continue;
        ++done;
        if (std::ranges::any_of(run.warnings, saysClockFell)) ++unsteady;
    }
    broken.insert(broken.end(), problems.begin(), problems.end());
    if (done == 0 || 20 * unsteady > done) broken.emplace_back("the clock fell in more than one run of twenty");
    return broken;
}

TEST(AcceptedMachines, KeepTheRules) {
    for (const std::string& name : files::listDataFolders("machines"))
        EXPECT_THAT(brokenRules(files::dataFolder() / "machines" / name), IsEmpty()) << name;
}

TEST(AcceptedMachines, ABrokenRuleIsNamed) {
    const TemporaryFolder folder;
    const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder.path() / name) << text; };
    write("summary.csv", "run_id,status,reason,repetition\na,done,,1\nb,skipped,too long,1\n");
    write("runs.csv", "run_id,key,state_hash,method_hash,warnings\na,,,,the machine is busy\n");
    write("selfcheck.json", "{\n  \"passed\": true\n}\n");
    EXPECT_THAT(brokenRules(folder.path()), ElementsAre(HasSubstr("other files")));
    write("machine.csv", "git_dirty,build_type\nfalse,Release\n");
    EXPECT_THAT(brokenRules(folder.path()), IsEmpty());
    write("machine.csv", "git_dirty,build_type\ntrue,Debug\n");
    write("summary.csv", "run_id,status,reason,repetition\na,failed,crash,1\nb,done,,1\n");
    write("runs.csv", "run_id,key,state_hash,method_hash,warnings\nb,,,,clock fell: the GPU's from 1800 to 900 MHz\n");
    write("selfcheck.json", "{\n  \"passed\": false\n}\n");
    EXPECT_THAT(brokenRules(folder.path()),
                ElementsAre("the self-check failed", "the program had changes", "the program was no release build",
                            "failed: a", HasSubstr("clock fell")));
    write("index.html", "<html>");
    EXPECT_THAT(brokenRules(folder.path()), ElementsAre(HasSubstr("other files")));
}

}  // namespace
}  // namespace dustbench::bench
