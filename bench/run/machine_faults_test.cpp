// Running out of resources is not a failure of a run, and an error of a run's process does not affect other runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "bench/results/summary.h"
#include "bench/run/executor.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::run {
namespace {
namespace fs = std::filesystem;

using testing::HasSubstr;

/// A plan of three runs. The process of the second is the test's script; the others write the files of a run.
class MachineFaults : public testing::Test {
 protected:
    void SetUp() override {
        for (std::uint64_t seed : {1u, 2u, 3u}) {
            suite::PlannedRun run;
            run.spec.method = "haze";
            run.spec.seed = seed;
            plan_.push_back(run);
            results::RunRecord record;
            record.spec = run.spec;
            record.summary = results::identityColumns(record, 2);
            folder_.write("made-" + results::runId(run.spec), results::toJson(record));
        }
    }
    [[nodiscard]] std::string made(std::size_t i) const {
        return (folder_.path() / ("made-" + results::runId(plan_[i].spec))).string();
    }
    [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }
    /// `script` sees the run's folder as $1.
    [[nodiscard]] ExecutionResult run(const std::string& script, const suite::ResourceLimits& limits = {},
                                      bool badInputEnds = false) {
        ExecutionOptions options;
        options.limits = limits;
        options.retryFailed = true;
        options.badInputEnds = badInputEnds;
        options.command = [&](const fs::path&, const fs::path& folder) -> std::vector<std::string> {
            const std::string name = folder.filename();
            const bool isSecond = name.ends_with(results::runId(plan_[1].spec));
            std::string file;
            for (std::size_t i = 0; i < plan_.size(); ++i)
                if (name.ends_with(results::runId(plan_[i].spec))) file = made(i);
            return {"/bin/sh", "-c", isSecond ? script : "cp " + file + " $1/run.json", "sh", folder.string()};
        };
        results::ResultsFolder results(out());
        ExecutionListener quiet;
        return execute(plan_, 1, results, options, quiet);
    }
    [[nodiscard]] std::string good() const { return "cp " + made(1) + " $1/run.json"; }
    [[nodiscard]] results::StoredRun second() const {
        return results::readRunFile(out() / "runs" / results::runId(plan_[1].spec) / "run.json");
    }
    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(out() / "runs"), {}));
    }
    /// The plan stops with this message, keeps only the first run, and continues when it is called again.
    void expectAborted(const std::string& script, const std::string& words) {
        try {
            (void)run(script);
            ADD_FAILURE() << "nothing thrown";
        } catch (const files::MachineError& error) {
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
        EXPECT_EQ(entries(), 1u);
        const ExecutionResult again = run(good());
        EXPECT_EQ(again.kept, 1u);
        EXPECT_EQ(again.done, 2u);
        EXPECT_EQ(again.failed, 0u);
    }

    TestFolder folder_;
    std::vector<suite::PlannedRun> plan_;
};

TEST_F(MachineFaults, ARunThatTheMachineAbortsIsNotAFailedOne) {
    expectAborted("echo 'error machine output a cannot be written: No space left on device'; exit 2",
                  "No space left on device");
}

TEST_F(MachineFaults, AFolderThatTakesNoMoreFilesIsNotAFailedRun) {
    // The limit applies to this process, whose probe after the failed run does not fit.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto formerly = signal(SIGXFSZ, SIG_IGN);
    const rlimit small{100'000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    expectAborted("exit 1", "File too large");
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, formerly);
}

TEST_F(MachineFaults, NoMoreOpenFilesIsSaidSo) {
    results::ResultsFolder results(out());
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    const rlimit few{static_cast<rlim_t>(dup(0)), before.rlim_max};  // the next open file exceeds the limit
    setrlimit(RLIMIT_NOFILE, &few);
    ExecutionOptions options;
    options.command = [](const fs::path&, const fs::path&) -> std::vector<std::string> { return {"/bin/true"}; };
    ExecutionListener quiet;
    EXPECT_THROW((void)execute(plan_, 1, results, options, quiet), files::MachineError);
    setrlimit(RLIMIT_NOFILE, &before);
    close(static_cast<int>(few.rlim_cur));
}

TEST_F(MachineFaults, AnotherRunsResultIsNotPublished) {
    const ExecutionResult result = run("cp " + made(0) + " $1/run.json");
    EXPECT_EQ(result.done, 2u);
    EXPECT_EQ(result.failed, 1u);
    EXPECT_EQ(second().runId, results::runId(plan_[1].spec));
    EXPECT_EQ(second().status, results::RunStatus::failed);
    EXPECT_THAT(second().reason, HasSubstr("wrote the result of another run, '" + results::runId(plan_[0].spec)));
}

TEST_F(MachineFaults, AMalformedResultFailsItsRunAlone) {
    for (const char* text : {"", "{", "[]", "null", "{\"run_id\": 3}"}) {
        const ExecutionResult result = run(std::string("echo '") + text + "' > $1/run.json");
        EXPECT_EQ(result.failed, 1u) << text;
        EXPECT_EQ(second().status, results::RunStatus::failed) << text;
        EXPECT_THAT(second().reason, HasSubstr("wrote a result that cannot be read")) << text;
    }
    EXPECT_EQ(run(good()).failed, 0u);
}

TEST_F(MachineFaults, ARunWithoutAWordIsNamedAllTheSame) {
    (void)run("exit 3");
    EXPECT_EQ(second().reason, "exit code 3, without an error message");
    EXPECT_EQ(run("exit 3", {}, true).failed, 1u) << "no error says that the input is bad";
}

TEST_F(MachineFaults, NoDescendantOutlivesItsRun) {
    const fs::path pids = folder_.path() / "pids";
    // In their own sessions, twice, so that the signal to the process group does not reach them.
    const std::string left = "setsid sh -c 'echo $$ >> " + pids.string() + "; setsid sh -c \"echo \\$\\$ >> " +
                             pids.string() + "; exec sleep 600\" & exec sleep 600' & ";
    std::ofstream(pids).close();  // exists before either process starts, to be counted
    EXPECT_EQ(run(left + "while [ $(wc -l < " + pids.string() + ") -lt 2 ]; do sleep 0.01; done; " + good()).done, 3u);
    std::ifstream file(pids);
    int count = 0;
    for (pid_t pid = 0; file >> pid; ++count) EXPECT_NE(kill(pid, 0), 0) << pid;
    EXPECT_EQ(count, 2);
}

TEST_F(MachineFaults, ARunThatNeedsMoreMemoryThanItMayFails) {
    const ExecutionResult result = run("echo 'error memory out of memory'; exit 2", {500, 0});
    EXPECT_EQ(result.failed, 1u);
    EXPECT_EQ(second().reason, "exceeds the memory limit of 500 MB (memory_limit_mb)");
}

TEST_F(MachineFaults, TheMemoryLimitIsTheProcesses) {
    EXPECT_EQ(run("ulimit -d > $1/limit; " + good(), {512, 0}).done, 3u);
    std::ifstream file(out() / "runs" / results::runId(plan_[1].spec) / "limit");
    std::int64_t kibibytes = 0;
    file >> kibibytes;
    EXPECT_EQ(kibibytes, 512'000'000 / 1024);
}

TEST_F(MachineFaults, ARunThatNeedsMoreProcessorTimeThanItMayFails) {
    const ExecutionResult result = run("while :; do :; done", {0, 1});
    EXPECT_EQ(result.failed, 1u);
    EXPECT_EQ(second().reason, "exceeds the limit of 1 s of processor time (cpu_limit_s)");
}

TEST_F(MachineFaults, AFloodOfOutputIsRead) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run("head -c 300000000 /dev/zero; head -c 30000000 /dev/zero | tr '\\0' '\\n'; " + good()).done, 3u);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(2));
}

}  // namespace
}  // namespace dustbench::run
