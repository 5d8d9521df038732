// Faults during a long list of runs: kills, a damaged result, a removed folder, another build.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <thread>

#include "bench/measure/sha256.h"
#include "bench/results/freshness.h"
#include "bench/results/summary.h"
#include "bench/run/executor.h"
#include "bench/run/run_forecast.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::run {
namespace {
namespace fs = std::filesystem;

constexpr int runsInPlan = 30;
constexpr int rowsOfFrames = 50;

/// Children are shell scripts that take a few milliseconds and leave frames.csv and a run.json made beforehand.
class ExecutorFaults : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("faults-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
                   std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "made");
        std::ofstream(folder_ / "input") << "first";
        for (int i = 0; i < runsInPlan; ++i) {
            suite::PlannedRun run;
            run.spec.method = "haze";
            run.spec.seed = static_cast<std::uint64_t>(i);
            plan_.push_back(run);
            results::RunRecord record;
            record.spec = run.spec;
            record.provenance.build = measure::buildFacts();
            record.provenance.inputs = measure::hashInputs({folder_ / "input"});
            record.summary = results::identityColumns(record, 2);
            record.outputs = {{"frames.csv", frames().size(), measure::sha256(frames())}};
            exports::writeWhole(folder_ / "made" / results::runId(run.spec), results::toJson(record));
        }
        options_.retryFailed = true;
        options_.command = [this](const fs::path&, const fs::path& folder) -> std::vector<std::string> {
            std::string id = folder.filename();
            id = id.substr(id.find('-') + 1);
            return {"/bin/sh", "-c", script_, "sh", folder.string(), (folder_ / "made" / id).string(), pid().string()};
        };
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Files that the script writes.
    static std::string frames() {
        std::string text = "frame\n";
        for (int i = 0; i < rowsOfFrames; ++i) text += fmt::format("{}\n", i);
        return text;
    }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    [[nodiscard]] fs::path pid() const { return folder_ / "pid"; }
    [[nodiscard]] ExecutionResult runAll() const {
        results::ResultsFolder results(out());
        ExecutionListener quiet;
        return execute(plan_, 1, results, options_, quiet);
    }
    /// Names of the results that a reader sees; checks that each is complete and matches its name.
    [[nodiscard]] std::set<std::string> wholeResults() const {
        std::set<std::string> names;
        std::error_code missing;
        for (const auto& entry : fs::directory_iterator(out() / "runs", missing)) {
            const std::string name = entry.path().filename();
            if (name.starts_with('.')) continue;
            const results::StoredRun run = results::readRunFile(entry.path() / "run.json");
            EXPECT_EQ(run.runId, name);
            if (run.status != results::RunStatus::done) continue;
            EXPECT_EQ(files::CsvTable::parseFile(entry.path() / "frames.csv").rows(), std::size_t{rowsOfFrames});
            names.insert(name);
        }
        return names;
    }

    fs::path folder_;
    std::vector<suite::PlannedRun> plan_;
    ExecutionOptions options_;
    std::string script_ = "echo $$ > $3; echo frame > $1/frames.csv; i=0; while [ $i -lt " +
                          std::to_string(rowsOfFrames) +
                          " ]; do echo $i >> $1/frames.csv; i=$((i+1)); done; sleep 0.01; cp $2 $1/run.json";
};

TEST_F(ExecutorFaults, FiftyKillsLoseNothingThatWasFinished) {
    std::set<std::string> finished;
    for (std::uint64_t kill = 0; kill < 50; ++kill) {
        const auto words = maths::randomWords(3, 0, kill);
        fs::remove(pid());
        const pid_t parent = fork();
        if (parent == 0) {
            try {
                (void)runAll();
            } catch (const std::exception& error) {
                fmt::print(stderr, "kill {}: {}\n", kill, error.what());
                _exit(1);
            }
            _exit(0);
        }
        // Long enough for one or two runs, so that the last kills still hit a running plan.
        std::this_thread::sleep_for(std::chrono::microseconds(1000 + words[0] % 40'000));
        pid_t child = 0;
        std::ifstream(pid()) >> child;
        if (words[1] % 2 == 0 && child > 0) {
            ::kill(child, SIGKILL);
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        ::kill(parent, SIGKILL);
        int status = 0;
        waitpid(parent, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << "kill " << kill;

        const std::set<std::string> now = wholeResults();
        EXPECT_TRUE(std::ranges::includes(now, finished)) << "kill " << kill;
        finished = now;
        if (fs::exists(out() / "summary.csv")) {
            EXPECT_NO_THROW((void)files::CsvTable::parseFile(out() / "summary.csv")) << "kill " << kill;
        }
    }
    const ExecutionResult result = runAll();
    EXPECT_EQ(result.failed, 0u);
    EXPECT_EQ(result.kept + result.done, std::size_t{runsInPlan});
    EXPECT_EQ(wholeResults().size(), std::size_t{runsInPlan});
    EXPECT_EQ(std::distance(fs::directory_iterator(out() / "runs"), fs::directory_iterator()), runsInPlan);
    const auto table = files::CsvTable::parseFile(out() / "summary.csv");
    std::set<std::string> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) rows.insert(table.cell(row, "run_id"));
    EXPECT_EQ(table.rows(), std::size_t{runsInPlan});
    EXPECT_EQ(rows, wholeResults());
}

TEST_F(ExecutorFaults, ADamagedResultIsSetAsideAndDoneAgain) {
    (void)runAll();
    const std::string cut = results::runId(plan_[3].spec), foreign = results::runId(plan_[4].spec);
    fs::resize_file(out() / "runs" / cut / "run.json", 100);
    std::ofstream(out() / "runs" / foreign / "run.json") << "[]";
    {
        const results::ResultsFolder results(out());
        ASSERT_EQ(results.setAside().size(), 2u);
        EXPECT_NE(results.setAside()[0].find("run.json"), std::string::npos);
    }
    EXPECT_TRUE(fs::exists(out() / "runs" / (".damaged-" + cut) / "frames.csv"));
    const ExecutionResult again = runAll();
    EXPECT_EQ(again.done, 2u);
    EXPECT_EQ(wholeResults().size(), std::size_t{runsInPlan});
}

TEST_F(ExecutorFaults, AnAlteredOrMissingFileOfAResultDoesNotCountAsDone) {
    (void)runAll();
    const auto tableOf = [&](std::size_t i) { return out() / "runs" / results::runId(plan_[i].spec) / "frames.csv"; };
    fs::remove(tableOf(3));
    std::ofstream(tableOf(4), std::ios::in) << 'F';  // of the same length
    {
        const results::ResultsFolder results(out());
        EXPECT_EQ(results.runs().size(), std::size_t{runsInPlan} - 2);
        ASSERT_EQ(results.setAside().size(), 2u);
        const std::string said = results.setAside()[0] + results.setAside()[1];
        EXPECT_NE(said.find("frames.csv is missing"), std::string::npos) << said;
        EXPECT_NE(said.find("frames.csv was altered"), std::string::npos) << said;
    }
    EXPECT_EQ(runAll().done, 2u);
    EXPECT_EQ(wholeResults().size(), std::size_t{runsInPlan});
    EXPECT_EQ(runAll().kept, std::size_t{runsInPlan});
}

TEST_F(ExecutorFaults, AKillBetweenTheRenamesOfAReplacementKeepsTheOldResult) {
    (void)runAll();
    const fs::path runs = out() / "runs";
    const std::string id = results::runId(plan_[5].spec);
    fs::rename(runs / id, runs / (".replaced-" + id));
    EXPECT_EQ(runAll().kept, std::size_t{runsInPlan});
    EXPECT_EQ(wholeResults().size(), std::size_t{runsInPlan});
}

TEST_F(ExecutorFaults, AFolderRemovedInTheMiddleIsSaidAndTheSameCallGoesOn) {
    script_ = "if [ ! -e $3 ]; then echo > $3; rm -r " + out().string() + "; exit 1; fi; " + script_;
    try {
        (void)runAll();
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("cannot be written"), std::string::npos) << error.what();
    }
    EXPECT_EQ(runAll().done, std::size_t{runsInPlan});
}

TEST_F(ExecutorFaults, ARunWithoutRoomForItsFilesIsNotBegun) {
    plan_.resize(1);
    plan_[0].spec.imagesEvery = 1;
    plan_[0].spec.frames = 10'000'000;
    plan_[0].spec.size = {16384, 16384};
    try {
        (void)runAll();
        FAIL() << "nothing thrown";
    } catch (const files::MachineError& error) {
        EXPECT_NE(std::string(error.what()).find(" TB"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(ExecutorFaults, OutdatedResultsAreCountedAndDoneAgainWhenAsked) {
    plan_.resize(3);
    (void)runAll();
    EXPECT_EQ(runAll().outdated, 0u);
    std::ofstream(folder_ / "input") << "second";
    const ExecutionResult changed = runAll();
    EXPECT_EQ(changed.kept, 3u);
    EXPECT_EQ(changed.outdated, 3u);
    EXPECT_NE(changed.whyOutdated.find("input has changed since"), std::string::npos) << changed.whyOutdated;
    options_.redoOutdated = true;
    EXPECT_EQ(runAll().done, 3u);
}

TEST(Freshness, TellsAnotherBuildFromThisOne) {
    results::StoredRun run;
    run.provenance = {{"build_id", "0123"}, {"git_commit", "0123456789abcdef"}};
    EXPECT_EQ(results::Freshness("0123").whyOutdated(run), "");
    EXPECT_EQ(results::Freshness("4567").whyOutdated(run),
              "measured by another build of dustbench, commit 0123456789ab");
    run.status = results::RunStatus::failed;
    EXPECT_EQ(results::Freshness("4567").whyOutdated(run), "");
}

TEST(RemainingTime, CountsARunAsLongAsTheOthersOfItsCell) {
    std::vector<suite::PlannedRun> plan(6);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        plan[i].spec.seed = i % 3;
        plan[i].spec.repetition = static_cast<int>(i / 3) + 1;
    }
    std::vector<const suite::PlannedRun*> toDo;
    toDo.reserve(plan.size());
    for (const suite::PlannedRun& run : plan) toDo.push_back(&run);
    RemainingTime remaining(toDo);
    EXPECT_LT(remaining.seconds(), 0);
    remaining.ended(0, 2);
    EXPECT_DOUBLE_EQ(remaining.seconds(), 2 * 5);  // nothing else is known
    remaining.ended(1, 10);
    EXPECT_DOUBLE_EQ(remaining.seconds(), 6 + 2 + 10 + 6);
    std::size_t run = 2;
    for (const double seconds : {3.0, 2.0, 10.0, 3.0}) remaining.ended(run++, seconds);
    EXPECT_DOUBLE_EQ(remaining.seconds(), 0);
}

}  // namespace
}  // namespace dustbench::run
