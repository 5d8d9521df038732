// Runs a command in a process of its own, with a time limit, and says what became of it.
//
// The child cannot outlive this process: the kernel kills it when its parent dies. Threads: call from the main thread.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::bench {

struct ChildOutcome {
    enum class End { exited, killedBySignal, timedOut, interrupted };
    End end = End::exited;
    int code = 0;           ///< exit status, or the signal's number
    std::string lastWords;  ///< the last line on its stderr that is not blank
    [[nodiscard]] bool succeeded() const { return end == End::exited && code == 0; }
    /// `killed by SIGSEGV: …`, `exit code 1: …`, `no end after 600 s`.
    [[nodiscard]] std::string reason() const;
    double timeoutSeconds = 0;
};

struct ChildCommand {
    std::vector<std::string> argv;  ///< argv[0] is the program's path
    std::filesystem::path log;      ///< takes its stderr, of very much its beginning and its end
    double timeoutSeconds = 0;      ///< 0: no limit
    /// Gets every line of its stdout, and an empty line about once a second where it says nothing.
    std::function<void(std::string_view)> onLine;
    /// Asked several times a second; true kills the child.
    std::function<bool()> interrupted;
};

/// Waits for its end. Throws std::runtime_error where no process can be made.
[[nodiscard]] ChildOutcome runChild(const ChildCommand& command);

}  // namespace dustbench::bench
