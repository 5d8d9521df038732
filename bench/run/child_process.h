// Runs a command in a child process with a time limit and reports how it ended.
//
// The child cannot outlive this process: the kernel kills it when its parent dies. Processes that the child started
// cannot outlive it either, in whatever session: this process becomes the parent of such orphans and kills them,
// including orphans of other children that still run.
// Threads: call from the main thread, and start no processes from other threads meanwhile.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/suite/resource_limits.h"

namespace dustbench::run {

struct ChildOutcome {
    enum class End { exited, killedBySignal, timedOut, interrupted };
    End end = End::exited;
    int code = 0;           ///< exit status, or the signal's number
    std::string lastWords;  ///< the last non-blank line on its stderr
    [[nodiscard]] bool succeeded() const { return end == End::exited && code == 0; }
    /// `killed by SIGSEGV: …`, `exit code 1: …`, `not finished after 600 s`.
    [[nodiscard]] std::string reason() const;
    double timeoutSeconds = 0;
};

struct ChildCommand {
    std::vector<std::string> argv;  ///< argv[0] is the program's path
    std::filesystem::path log;      ///< receives its stderr; only the beginning and the end of long output
    double timeoutSeconds = 0;      ///< 0: no limit
    /// Receives every line of its stdout, and an empty line about once a second while there is no output.
    std::function<void(std::string_view)> onLine;
    /// Called several times a second; returning true kills the child.
    std::function<bool()> interrupted;
    suite::ResourceLimits limits{};
};

/// A child process, which may still be running. Several can run at a time.
///
/// Threads: the main thread only.
class ChildProcess {
 public:
    /// Throws std::runtime_error if it cannot be created; files::MachineError if memory, files or processes have run
    /// out.
    explicit ChildProcess(ChildCommand command);
    /// Kills it and the processes it started if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Reads its output, waiting for at most this long. True once it has ended.
    [[nodiscard]] bool advance(std::chrono::milliseconds atMost);
    /// How it ended.
    [[nodiscard]] const ChildOutcome& outcome() const;

 private:
    class State;
    std::unique_ptr<State> state_;
};

/// Waits for the child to end. Throws as the constructor of ChildProcess.
[[nodiscard]] ChildOutcome runChild(const ChildCommand& command);

/// A log file of bounded size for a process's output: complete if short, otherwise only its beginning and end.
class BoundedLog {
 public:
    static constexpr std::size_t headBytes = 1 << 20;
    static constexpr std::size_t tailBytes = 64 << 10;

    /// Throws InputError if the file cannot be created.
    explicit BoundedLog(const std::filesystem::path& file);

    void write(std::string_view text);
    /// Writes the rest: the number of missing bytes, if any, and the end of the output.
    void finish();

    /// The last non-blank line so far, cut after 500 bytes.
    [[nodiscard]] std::string lastLine() const;

 private:
    std::ofstream stream_;
    std::uint64_t written_ = 0;
    std::uint64_t received_ = 0;
    std::string tail_;  ///< the last bytes received, up to twice `tailBytes`
};

}  // namespace dustbench::run
