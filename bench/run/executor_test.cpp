#include "bench/run/executor.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "bench/results/summary.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::run {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;

/// A plan of four runs and a folder for their results. Children are shell scripts that copy the files of a run.
class Executor : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) /
                  (std::string("executor-") + testing::UnitTest::GetInstance()->current_test_info()->name() + "-" +
                   std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "made");
        for (int i = 0; i < 4; ++i) {
            suite::PlannedRun run;
            run.spec.method = "haze";
            run.spec.seed = static_cast<std::uint64_t>(i);
            run.spec.parameters["note"] = "a,b \"c\"";
            plan_.push_back(run);
            results::RunRecord record;
            record.spec = run.spec;
            record.summary = results::identityColumns(record, 2);
            exports::writeWhole(made(run), results::toJson(record));
        }
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path made(const suite::PlannedRun& run) const {
        return folder_ / "made" / results::runId(run.spec);
    }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }

    /// `script` sees the run's folder as $1 and the finished run.json as $2.
    [[nodiscard]] ExecutionOptions shell(const std::string& script) const {
        ExecutionOptions options;
        options.command = [script, this](const fs::path&, const fs::path& folder) -> std::vector<std::string> {
            std::string id = folder.filename();
            id = id.substr(id.find('-') + 1);
            return {"/bin/sh", "-c", script, "sh", folder.string(), (folder_ / "made" / id).string()};
        };
        return options;
    }
    [[nodiscard]] ExecutionResult runAll(const ExecutionOptions& options) {
        results::ResultsFolder results(out());
        ExecutionListener quiet;
        return execute(plan_, 1, results, options, quiet);
    }
    /// Names in runs/, including hidden ones.
    [[nodiscard]] std::vector<std::string> entries() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(out() / "runs")) names.push_back(entry.path().filename());
        return names;
    }

    fs::path folder_;
    std::vector<suite::PlannedRun> plan_;
};

constexpr const char* good = "cp \"$2\" \"$1/run.json\"";

TEST_F(Executor, RecordsWhatTheSuiteLeavesOutAndRunsItOnceTheSuiteWantsIt) {
    plan_[2].skip = "takes minutes a frame";
    for (const std::size_t kept : {0u, 4u}) {
        const ExecutionResult result = runAll(shell(good));
        EXPECT_EQ(result.kept, kept);
        EXPECT_EQ(result.done + result.skipped + result.kept, 4u);
        const auto table = files::CsvTable::parseFile(out() / "summary.csv");
        ASSERT_EQ(table.rows(), 4u);
        int skipped = 0;
        for (std::size_t row = 0; row < 4; ++row) {
            if (table.cell(row, "status") != "skipped") continue;
            ++skipped;
            EXPECT_EQ(table.cell(row, "reason"), "left out by the suite: takes minutes a frame");
            EXPECT_EQ(table.cell(row, "seed"), "2");
        }
        EXPECT_EQ(skipped, 1);
    }
    plan_[2].skip.clear();
    EXPECT_EQ(runAll(shell(good)).done, 1u);
    EXPECT_EQ(runAll(shell(good)).kept, 4u);
}

/// Waits until `count` runs are in progress; fails after 20 s.
std::string meeting(const fs::path& place, int count) {
    return fmt::format(
        "touch {0}/$$; i=0; while [ $(ls {0} | wc -l) -lt {1} ]; do i=$((i+1)); [ $i -gt 2000 ] && exit 1; "
        "sleep 0.01; done; ",
        place.string(), count);
}

TEST_F(Executor, RunsSeveralAtATimeIfAsked) {
    fs::create_directory(folder_ / "there");
    ExecutionOptions options = shell(meeting(folder_ / "there", 3) + good);
    options.simultaneous = 3;
    const ExecutionResult result = runAll(options);
    EXPECT_EQ(result.done, 4u);
    EXPECT_EQ(result.failed, 0u);
    EXPECT_EQ(entries().size(), 4u);
    EXPECT_EQ(files::CsvTable::parseFile(out() / "summary.csv").rows(), 4u);
}

TEST_F(Executor, OfSeveralAtATimeOneFaultOfTheMachineStopsAllAndLeavesNothingHalfDone) {
    fs::create_directory(folder_ / "there");
    // One of three aborts once all three have started; the others would never end.
    ExecutionOptions options =
        shell(meeting(folder_ / "there", 3) +
              fmt::format("mkdir {0} 2>/dev/null && {{ echo 'error machine no more ink'; exit 2; }}; sleep 600",
                          (folder_ / "first").string()));
    options.simultaneous = 3;
    EXPECT_THROW((void)runAll(options), files::MachineError);
    EXPECT_FALSE(fs::exists(out()));
    ExecutionOptions again = shell(good);
    again.simultaneous = 3;
    EXPECT_EQ(runAll(again).done, 4u);
}

TEST_F(Executor, SeveralAtATimeAreAllInterrupted) {
    fs::create_directory(folder_ / "there");
    ExecutionOptions options = shell(meeting(folder_ / "there", 2) + "touch \"$1/../../met\"; sleep 600");
    options.simultaneous = 2;
    options.interrupted = [this] { return fs::exists(out() / "met"); };
    const ExecutionResult result = runAll(options);
    EXPECT_TRUE(result.aborted);
    EXPECT_EQ(result.done + result.failed, 0u);
    EXPECT_TRUE(entries().empty());
}

TEST_F(Executor, KeepsEveryRunAndSummarisesThem) {
    const ExecutionResult result = runAll(shell(good));
    EXPECT_EQ(result.done, 4u);
    EXPECT_EQ(result.failed, 0u);
    const auto table = files::CsvTable::parseFile(out() / "summary.csv");
    ASSERT_EQ(table.rows(), 4u);
    EXPECT_EQ(table.cell(0, "status"), "done");
    EXPECT_EQ(table.cell(0, "p.note"), "a,b \"c\"");
    EXPECT_EQ(table.cell(0, "psnr_db"), "");
    for (const suite::PlannedRun& run : plan_) {
        const fs::path folder = out() / "runs" / results::runId(run.spec);
        EXPECT_TRUE(fs::exists(folder / "run.json"));
        EXPECT_FALSE(fs::exists(folder / "spec.json"));
        EXPECT_FALSE(fs::exists(folder / "log.txt"));
    }
}

TEST_F(Executor, ResumesWithWhatIsMissing) {
    (void)runAll(shell(good));
    fs::remove_all(out() / "runs" / results::runId(plan_[2].spec));
    const ExecutionResult again = runAll(shell(good));
    EXPECT_EQ(again.kept, 3u);
    EXPECT_EQ(again.done, 1u);
    ExecutionOptions force = shell(good);
    force.force = true;
    EXPECT_EQ(runAll(force).done, 4u);
}

TEST_F(Executor, ACrashIsAFailedRunAndThePlanGoesOn) {
    const std::string crash = "case $2 in *" + results::runId(plan_[1].spec) +
                              ") touch $1/frames.csv; echo 'bad thing' >&2; kill -ABRT $$;; esac; ";
    const ExecutionResult result = runAll(shell(crash + good));
    EXPECT_EQ(result.failed, 1u);
    EXPECT_EQ(result.done, 3u);
    const fs::path folder = out() / "runs" / results::runId(plan_[1].spec);
    const results::StoredRun run = results::readRunFile(folder / "run.json");
    EXPECT_EQ(run.status, results::RunStatus::failed);
    EXPECT_EQ(run.reason, "killed by SIGABRT: bad thing");
    EXPECT_TRUE(fs::exists(folder / "log.txt"));
    EXPECT_FALSE(fs::exists(folder / "frames.csv"));
    // It stays failed until a retry is requested.
    EXPECT_EQ(runAll(shell(good)).failed, 1u);
    ExecutionOptions retry = shell(good);
    retry.retryFailed = true;
    const ExecutionResult after = runAll(retry);
    EXPECT_EQ(after.failed, 0u);
    EXPECT_EQ(after.done, 1u);
    EXPECT_EQ(after.kept, 3u);
}

TEST_F(Executor, AHangIsATimeoutThatSaysHowFarItCame) {
    ExecutionOptions options =
        shell("case $2 in *" + results::runId(plan_[0].spec) + ") echo frames 3 9; sleep 600;; esac; " + good);
    options.timeoutSeconds = 5;  // the three good runs take a few milliseconds each, even on a busy machine
    const ExecutionResult result = runAll(options);
    EXPECT_EQ(result.failed, 1u);
    EXPECT_EQ(result.done, 3u);
    const results::StoredRun run = results::readRunFile(out() / "runs" / results::runId(plan_[0].spec) / "run.json");
    EXPECT_EQ(run.status, results::RunStatus::timeout);
    EXPECT_EQ(run.reason, "not finished after 5 s (at frames 3 9)");
}

TEST_F(Executor, AChildWithoutAResultHasFailed) {
    const ExecutionResult result = runAll(shell("exit 0"));
    EXPECT_EQ(result.failed, 4u);
}

TEST_F(Executor, BadInputEndsThePlanWithTheChildsWords) {
    ExecutionOptions options = shell("echo 'error input no such thing'; exit 3");
    options.badInputEnds = true;
    try {
        (void)runAll(options);
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "no such thing");
    }
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Executor, InterruptionLeavesNothingOfTheRunInFlight) {
    ExecutionOptions options = shell("sleep 600");
    options.interrupted = [] { return true; };
    EXPECT_TRUE(runAll(options).aborted);
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Executor, AKillLosesAtMostTheRunInFlightAndTheNextCallResumes) {
    // The third run hangs after the first two are complete; then the whole process is killed.
    const std::string hang =
        "case $2 in *" + results::runId(plan_[2].spec) + ") touch $1/frames.csv; sleep 600;; esac; ";
    const pid_t victim = fork();
    if (victim == 0) {
        (void)runAll(shell(hang + good));
        _exit(0);
    }
    const fs::path half = out() / "runs" / (".unfinished-" + results::runId(plan_[2].spec)) / "frames.csv";
    for (int i = 0; i < 6'000 && !fs::exists(half); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(fs::exists(half));
    kill(victim, SIGKILL);
    waitpid(victim, nullptr, 0);

    std::vector<std::string> visible;
    for (const std::string& name : entries())
        if (!name.starts_with('.')) visible.push_back(name);
    EXPECT_THAT(visible, testing::UnorderedElementsAre(results::runId(plan_[0].spec), results::runId(plan_[1].spec)));

    const ExecutionResult result = runAll(shell(good));
    EXPECT_EQ(result.kept, 2u);
    EXPECT_EQ(result.done, 2u);
    EXPECT_EQ(entries().size(), 4u);
    EXPECT_EQ(files::CsvTable::parseFile(out() / "summary.csv").rows(), 4u);
}

TEST_F(Executor, TwoProgramsDoNotWriteIntoOneFolder) {
    const results::ResultsFolder first(out());
    EXPECT_THROW(results::ResultsFolder second(out()), InputError);
}

TEST_F(Executor, AFolderThatCannotBeMadeIsBadInput) {
    std::ofstream(folder_ / "file") << "x";
    try {
        const results::ResultsFolder results(folder_ / "file" / "out");
        FAIL() << "nothing thrown";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("cannot be written"));
    }
}

}  // namespace
}  // namespace dustbench::run
