#include "bench/suite/machine/machine_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "bench/measure/clock_watch.h"
#include "bench/results/compared_runs.h"
#include "bench/results/run_tables.h"
#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::suite {
namespace {

TEST(MachinePlan, PlacesEachCellOfItsSuitesOnce) {
    for (const bool quick : {false, true}) {
        const MachinePlan plan = loadMachinePlan(quick);
        const std::vector<PlacedCell> cells = cellsOf(plan);
        std::set<std::string> places, ids;
        for (const PlacedCell& cell : cells) {
            const LadderCell& at = cell.ladder;
            places.insert(at.suite + at.ladder + std::to_string(at.load) + " " + std::to_string(at.pixels));
            ids.insert(results::runId(cell.run.spec));
        }
        EXPECT_EQ(places.size(), cells.size());
        EXPECT_EQ(ids.size(), cells.size()) << "no run belongs to two suites";
        EXPECT_LT(plan.hardware.totalSeconds, 600 + 1);
        EXPECT_LT(plan.software.totalSeconds, 1800 + 1);
    }
}

TEST(MachinePlan, JudgesPicturesAtTheSmallestSizeAlone) {
    double smallest = 1e12;
    const std::vector<PlacedCell> cells = cellsOf(loadMachinePlan(false));
    for (const PlacedCell& cell : cells) smallest = std::min(smallest, cell.ladder.pixels);
    bool evaluates = false;
    for (const PlacedCell& cell : cells) {
        EXPECT_TRUE(!cell.ladder.evaluated || cell.ladder.pixels == smallest);
        evaluates = evaluates || cell.ladder.evaluated;
    }
    EXPECT_TRUE(evaluates);
}

TEST(MachinePlan, ALoadIsANumberOrTheCellsOfAGrid) {
    EXPECT_EQ(loadOf("1000"), 1000);
    EXPECT_EQ(loadOf("128x64x32"), 128 * 64 * 32);
    for (const char* wrong : {"", "all", "0", "12x", "x12", "-3"}) EXPECT_THROW((void)loadOf(wrong), InputError);
}

TEST(MachinePlan, TellsJudgingFromMeasuring) {
    results::StoredRun run;
    run.cells = {{"run_s", "10"}, {"start_s", "2"}, {"fps_avg", "20"}, {"rss_peak_bytes", "5000"}, {"gpu_bytes", "70"}};
    results::RunSpec spec;
    spec.warmup = 10;
    spec.frames = 50;
    RunNeeds needs = needsOf(run, spec);
    EXPECT_DOUBLE_EQ(needs.seconds, 10);
    EXPECT_DOUBLE_EQ(needs.metricSeconds, 0);
    EXPECT_DOUBLE_EQ(needs.hostBytes, 5000);
    EXPECT_DOUBLE_EQ(needs.deviceBytes, 70);
    spec.metricPlan.emplace();
    needs = needsOf(run, spec);
    EXPECT_DOUBLE_EQ(needs.seconds, 5);
    EXPECT_DOUBLE_EQ(needs.metricSeconds, 5);
}

// The rules of data/machines/README.md that the tables alone can show.
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
    for (const auto& [id, run] : results::readSummaryRuns(folder, problems)) {
        if (run.status == results::RunStatus::failed) broken.push_back("failed: " + id);
        if (run.status != results::RunStatus::done) continue;
        ++done;
        if (std::ranges::any_of(run.warnings, measure::saysClockFell)) ++unsteady;
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
    const results::TemporaryFolder folder;
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
}  // namespace dustbench::suite
