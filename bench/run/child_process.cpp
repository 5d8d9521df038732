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
#include <stdexcept>
#include <utility>

#include "bench/run/bounded_log.h"

namespace dustbench::bench {
namespace {

using Clock = std::chrono::steady_clock;

std::runtime_error systemError(const std::string& what) {
    return std::runtime_error(what + ": " + std::strerror(errno));
}

/// Owns a file descriptor.
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

/// Runs after fork: only async-signal-safe calls until exec.
[[noreturn]] void becomeCommand(char* const* argv, int output, int errors, pid_t parent) {
    setpgid(0, 0);  // Ctrl-C reaches only the parent, which then decides
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGPIPE, SIG_DFL);
    dup2(output, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    execv(argv[0], argv);
    const char* const message = std::strerror(errno);
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message, std::strlen(message));
    _exit(127);
}

/// The reading end of a child's stream and the handler of its data.
class Stream {
 public:
    Stream(int readingEnd, std::function<void(std::string_view)> take)
        : descriptor_(readingEnd), take_(std::move(take)) {}

    [[nodiscard]] pollfd watched() const { return {open_ ? descriptor_.get() : -1, POLLIN, 0}; }
    /// Call when data or the end of the stream is available.
    void read() {
        std::array<char, 65536> buffer;
        const ssize_t got = ::read(descriptor_.get(), buffer.data(), buffer.size());
        if (got > 0) take_(std::string_view(buffer.data(), static_cast<std::size_t>(got)));
        if (got == 0 || (got < 0 && errno != EINTR)) open_ = false;
    }
    void readWhatIsThere() {
        for (pollfd now = watched(); open_ && poll(&now, 1, 0) > 0;) read();
    }

 private:
    Descriptor descriptor_;
    std::function<void(std::string_view)> take_;
    bool open_ = true;
};

/// Assembles lines from chunks. A line without an end is dropped once it is too long.
class LineSplitter {
 public:
    explicit LineSplitter(std::function<void(std::string_view)> onLine) : onLine_(std::move(onLine)) {}

    void take(std::string_view piece) {
        pending_ += piece;
        std::size_t start = 0;
        for (std::size_t end; (end = pending_.find('\n', start)) != std::string::npos; start = end + 1)
            if (onLine_) onLine_(std::string_view(pending_).substr(start, end - start));
        pending_.erase(0, start);
        if (pending_.size() > 65536) pending_.clear();
    }

 private:
    std::function<void(std::string_view)> onLine_;
    std::string pending_;
};

/// Both ends of a new pipe.
std::pair<int, int> newPipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw systemError("pipe");
    return {ends[0], ends[1]};
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
    argv.reserve(command.argv.size() + 1);
    for (const std::string& word : command.argv) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);

    BoundedLog log(command.log);
    LineSplitter lines(command.onLine);
    const auto [outputEnd, outputStart] = newPipe();
    Stream output(outputEnd, [&](std::string_view piece) { lines.take(piece); });
    Descriptor outputOfChild(outputStart);
    const auto [errorsEnd, errorsStart] = newPipe();
    Stream errors(errorsEnd, [&](std::string_view piece) { log.write(piece); });
    Descriptor errorsOfChild(errorsStart);

    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) throw systemError("fork");
    if (child == 0) becomeCommand(argv.data(), outputStart, errorsStart, parent);
    setpgid(child, child);  // in both processes, whichever runs first
    outputOfChild.reset();
    errorsOfChild.reset();

    ChildOutcome outcome;
    outcome.timeoutSeconds = command.timeoutSeconds;
    const auto start = Clock::now();
    auto lastSign = start;
    bool killed = false;
    int status = 0;
    // Its streams may stay open in processes that it left behind, or close early: only its own exit counts.
    for (;;) {
        std::array<pollfd, 2> watched{output.watched(), errors.watched()};
        poll(watched.data(), watched.size(), 100);
        const auto now = Clock::now();
        if (watched[1].revents != 0) errors.read();
        if (watched[0].revents != 0) {
            output.read();
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
    kill(-child, SIGKILL);  // processes that it may have started
    output.readWhatIsThere();
    errors.readWhatIsThere();
    log.finish();

    outcome.lastWords = log.lastLine();
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
