#include "bench/run/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace dustbench::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::runtime_error systemError(const std::string& what) {
    return std::runtime_error(what + ": " + std::strerror(errno));
}

/// A file descriptor that is closed once.
class Descriptor {
 public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() { reset(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int get() const { return value_; }
    void reset() {
        if (value_ >= 0) close(value_);
        value_ = -1;
    }

 private:
    int value_;
};

std::string lastLine(const std::filesystem::path& log) {
    std::ifstream file(log);
    std::string last;
    for (std::string line; std::getline(file, line);)
        if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    return last.substr(0, 500);
}

/// After fork: only what is safe between fork and exec.
[[noreturn]] void becomeCommand(char* const* argv, int output, int log, pid_t parent) {
    setpgid(0, 0);  // Ctrl-C reaches the parent alone, which then decides
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGPIPE, SIG_DFL);
    dup2(output, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv(argv[0], argv);
    const char* const message = std::strerror(errno);
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message, std::strlen(message));
    _exit(127);
}

/// Hands on whole lines of what the pipe holds; false at its end.
bool readLines(int pipe, std::string& pending, const std::function<void(std::string_view)>& onLine) {
    std::array<char, 4096> buffer;
    const ssize_t got = read(pipe, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) return true;
    if (got <= 0) return false;
    pending.append(buffer.data(), static_cast<std::size_t>(got));
    std::size_t start = 0;
    for (std::size_t end; (end = pending.find('\n', start)) != std::string::npos; start = end + 1)
        if (onLine) onLine(std::string_view(pending).substr(start, end - start));
    pending.erase(0, start);
    return true;
}

}  // namespace

std::string ChildOutcome::reason() const {
    const std::string words = lastWords.empty() ? "" : ": " + lastWords;
    switch (end) {
        case End::exited:
            return code == 0 ? "" : fmt::format("exit code {}{}", code, words);
        case End::killedBySignal: {
            const char* name = sigabbrev_np(code);
            return fmt::format("killed by {}{}", name ? std::string("SIG") + name : std::to_string(code), words);
        }
        case End::timedOut:
            return fmt::format("no end after {:g} s", timeoutSeconds);
        case End::interrupted:
            break;
    }
    return "interrupted";
}

ChildOutcome runChild(const ChildCommand& command) {
    std::vector<char*> argv;
    for (const std::string& word : command.argv) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);

    const Descriptor log(open(command.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (log.get() < 0) throw systemError(command.log.string());
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw systemError("pipe");
    const Descriptor output(ends[0]);
    Descriptor input(ends[1]);

    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) throw systemError("fork");
    if (child == 0) becomeCommand(argv.data(), input.get(), log.get(), parent);
    setpgid(child, child);  // here as well: whichever of the two comes first
    input.reset();

    ChildOutcome outcome;
    outcome.timeoutSeconds = command.timeoutSeconds;
    const auto start = Clock::now();
    std::string pending;
    auto lastSign = start;
    bool open = true, killed = false;
    int status = 0;
    // Its stdout may stay open in a process it left behind, or close early: its own end is what counts.
    for (;;) {
        pollfd watched{output.get(), POLLIN, 0};
        const int ready = poll(&watched, open ? 1 : 0, 100);
        const auto now = Clock::now();
        if (open && ready > 0) {
            open = readLines(output.get(), pending, command.onLine);
            lastSign = now;
        } else if (now - lastSign > std::chrono::seconds(1)) {
            if (command.onLine) command.onLine({});
            lastSign = now;
        }
        if (waitpid(child, &status, WNOHANG) == child) break;
        if (killed) continue;
        if (command.interrupted && command.interrupted()) {
            outcome.end = ChildOutcome::End::interrupted;
            killed = true;
        } else if (command.timeoutSeconds > 0 && now - start > std::chrono::duration<double>(command.timeoutSeconds)) {
            outcome.end = ChildOutcome::End::timedOut;
            killed = true;
        }
        if (killed) kill(-child, SIGKILL);
    }
    kill(-child, SIGKILL);  // what it may have started itself
    while (open && poll(std::array<pollfd, 1>{{{output.get(), POLLIN, 0}}}.data(), 1, 0) > 0)
        open = readLines(output.get(), pending, command.onLine);

    outcome.lastWords = lastLine(command.log);
    if (killed) return outcome;
    if (WIFSIGNALED(status)) {
        outcome.end = ChildOutcome::End::killedBySignal;
        outcome.code = WTERMSIG(status);
    } else {
        outcome.code = WEXITSTATUS(status);
    }
    return outcome;
}

}  // namespace dustbench::bench
