#include "bench/run/child_process.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

namespace dustbench::run {
namespace {

using End = ChildOutcome::End;

ChildCommand shell(const std::string& script) {
    ChildCommand command;
    command.argv = {"/bin/sh", "-c", script};
    command.log = std::filesystem::path(testing::TempDir()) / ("child-" + std::to_string(getpid()) + ".log");
    return command;
}

TEST(ChildProcess, HandsOnLinesAndExitCode) {
    std::vector<std::string> lines;
    ChildCommand command = shell("echo one; echo two; echo complaint >&2; exit 7");
    command.onLine = [&](std::string_view line) { lines.emplace_back(line); };
    const ChildOutcome outcome = runChild(command);
    EXPECT_THAT(lines, testing::ElementsAre("one", "two"));
    EXPECT_EQ(outcome.end, End::exited);
    EXPECT_EQ(outcome.code, 7);
    EXPECT_EQ(outcome.reason(), "exit code 7: complaint");
}

TEST(ChildProcess, NamesTheSignalThatKilledIt) {
    const ChildOutcome outcome = runChild(shell("echo last words >&2; kill -SEGV $$"));
    EXPECT_EQ(outcome.end, End::killedBySignal);
    EXPECT_EQ(outcome.reason(), "killed by SIGSEGV: last words");
}

TEST(ChildProcess, KeepsTheBeginningAndTheEndOfMegabytes) {
    ChildCommand command = shell(
        "echo first >&2; head -c 20000000 /dev/zero | tr '\\0' x >&2; head -c 20000000 /dev/zero; echo; echo fifth; "
        "echo >&2; echo last words >&2; exit 1");
    std::string lastLine;
    std::size_t longest = 0;
    command.onLine = [&](std::string_view line) {
        longest = std::max(longest, line.size());
        if (!line.empty()) lastLine = line;
    };
    EXPECT_EQ(runChild(command).reason(), "exit code 1: last words");
    EXPECT_EQ(lastLine, "fifth");
    EXPECT_LE(longest, 200'000u);
    std::ifstream file(command.log, std::ios::binary);
    const std::string log(std::istreambuf_iterator<char>(file), {});
    EXPECT_LE(log.size(), BoundedLog::headBytes + BoundedLog::tailBytes + 100);
    EXPECT_THAT(log, testing::AllOf(testing::StartsWith("first\nxxx"), testing::EndsWith("x\nlast words\n"),
                                    testing::HasSubstr(" bytes left out]")));
}

TEST(ChildProcess, EndsAHangWithEverythingItStarted) {
    ChildCommand command = shell("sleep 600 & echo $!; wait");
    pid_t grandchild = 0;
    command.onLine = [&](std::string_view line) {
        if (!line.empty()) grandchild = std::stoi(std::string(line));
    };
    command.timeoutSeconds = 2;
    const ChildOutcome outcome = runChild(command);
    EXPECT_EQ(outcome.end, End::timedOut);
    EXPECT_EQ(outcome.reason(), "not finished after 2 s");
    ASSERT_GT(grandchild, 0);
    // Dead, or a zombie that has not been reaped yet.
    const auto alive = [&] {
        std::ifstream file("/proc/" + std::to_string(grandchild) + "/stat");
        std::string pid, name, state;
        return (file >> pid >> name >> state) && state != "Z" && state != "X";
    };
    for (int i = 0; i < 500 && alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(alive());
}

TEST(ChildProcess, SeveralRunAtATimeAndTheEndOfOneLeavesTheOthers) {
    const std::string file = std::filesystem::path(testing::TempDir()) / ("meeting-" + std::to_string(getpid()));
    const auto logged = [&](ChildCommand command, const std::string& name) {
        command.log = file + name + ".log";
        return command;
    };
    // The first ends only once the second has begun, and the second only once the first has ended.
    ChildProcess first(logged(shell(fmt::format("while [ ! -e {0}-2 ]; do sleep 0.01; done; exit 3", file)), "1"));
    ChildProcess second(logged(
        shell(fmt::format("touch {0}-2; sleep 600 & while [ ! -e {0}-1 ]; do sleep 0.01; done; exit 4", file)), "2"));
    const auto end = [](ChildProcess& child) {
        for (int i = 0; i < 2000 && !child.advance(std::chrono::milliseconds(10)); ++i) {
        }
        return child.outcome();
    };
    EXPECT_EQ(end(first).code, 3);
    EXPECT_FALSE(second.advance(std::chrono::milliseconds(50)));
    std::ofstream(file + "-1") << "ended";
    EXPECT_EQ(end(second).code, 4);
    EXPECT_TRUE(first.advance(std::chrono::milliseconds(0)));
    for (const char* ending : {"-1", "-2", "1.log", "2.log"}) std::filesystem::remove(file + ending);
}

TEST(ChildProcess, IsKilledWithWhatItStartedIfNobodyWaitsForIt) {
    pid_t grandchild = 0;
    {
        ChildCommand command = shell("sleep 600 & echo $!; wait");
        command.onLine = [&](std::string_view line) {
            if (!line.empty()) grandchild = std::stoi(std::string(line));
        };
        ChildProcess child(std::move(command));
        while (grandchild == 0) (void)child.advance(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(kill(grandchild, 0), -1);
    EXPECT_EQ(errno, ESRCH);
}

TEST(ChildProcess, StopsWhenInterrupted) {
    ChildCommand command = shell("sleep 600");
    command.interrupted = [] { return true; };
    EXPECT_EQ(runChild(command).end, End::interrupted);
}

TEST(ChildProcess, SaysWhyACommandCannotStart) {
    ChildCommand command = shell("");
    command.argv = {"/nowhere/program"};
    EXPECT_THAT(runChild(command).reason(), testing::HasSubstr("No such file"));
}

TEST(ChildProcess, DoesNotOutliveItsParent) {
    const auto file = std::filesystem::path(testing::TempDir()) / ("orphan-" + std::to_string(getpid()));
    std::filesystem::remove(file);
    const pid_t parent = fork();
    if (parent == 0) {
        (void)runChild(shell("echo $$ > " + file.string() + "; exec sleep 600"));
        _exit(0);
    }
    pid_t child = 0;
    for (int i = 0; i < 1000 && child == 0; ++i) {
        std::ifstream(file) >> child;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    ASSERT_GT(child, 0);
    kill(parent, SIGKILL);
    waitpid(parent, nullptr, 0);
    const auto alive = [&] {
        std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
        std::string pid, name, state;
        return (stat >> pid >> name >> state) && state != "Z" && state != "X";
    };
    for (int i = 0; i < 1000 && alive(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(alive());
}

}  // namespace
}  // namespace dustbench::run
