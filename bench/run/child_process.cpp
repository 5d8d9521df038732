#include "bench/run/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "bench/export/whole_file.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::run {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void fail(const std::string& what) {
    const int error = errno;
    const std::string message = "a process cannot be started: " + what + ": " + std::strerror(error);
    if (files::isOfMachine(error) || error == EAGAIN) throw files::MachineError(message);
    throw std::runtime_error(message);
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

void setLimits(const suite::ResourceLimits& limits) {
    const auto set = [](auto resource, std::int64_t value, std::int64_t grace) {
        const rlimit limit{static_cast<rlim_t>(value), static_cast<rlim_t>(value + grace)};
        if (value > 0) setrlimit(resource, &limit);
    };
    set(RLIMIT_DATA, limits.memoryMegabytes * 1'000'000, 0);
    set(RLIMIT_CPU, limits.cpuSeconds, 5);  // SIGXCPU at the limit, SIGKILL after the grace period
}

/// Runs between fork and exec: only async-signal-safe calls.
[[noreturn]] void becomeCommand(char* const* argv, int output, int errors, pid_t parent,
                                const suite::ResourceLimits& limits) {
    setpgid(0, 0);  // Ctrl-C reaches only the parent, which decides
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGPIPE, SIG_DFL);
    dup2(output, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    setLimits(limits);
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
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
    return {ends[0], ends[1]};
}

/// The processes whose parent is this one.
std::set<pid_t> children() {
    std::set<pid_t> list;
    std::error_code error;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
        std::ifstream file(thread.path() / "children");
        for (pid_t child = 0; file >> child;) list.insert(child);
    }
    return list;
}

/// The children that are running now.
std::set<pid_t>& running() {
    static std::set<pid_t> list;
    return list;
}

/// Kills the orphans of a child and their orphans, but not the processes that existed before, nor other children.
void killOrphans(const std::set<pid_t>& before) {
    for (bool found = true; found;) {
        found = false;
        for (const pid_t orphan : children()) {
            if (before.contains(orphan) || running().contains(orphan)) continue;
            found = true;
            kill(orphan, SIGKILL);
            waitpid(orphan, nullptr, 0);
        }
    }
}

}  // namespace

std::string ChildOutcome::reason() const {
    const std::string words = lastWords.empty() ? "" : ": " + lastWords;
    switch (end) {
        case End::exited:
            return code == 0
                       ? ""
                       : fmt::format("exit code {}{}", code, words.empty() ? ", without an error message" : words);
        case End::killedBySignal: {
            const char* name = sigabbrev_np(code);
            return fmt::format("killed by {}{}", name ? std::string("SIG") + name : std::to_string(code), words);
        }
        case End::timedOut:
            return fmt::format("not finished after {:g} s", timeoutSeconds);
        case End::interrupted:
            break;
    }
    return "interrupted";
}

class ChildProcess::State {
 public:
    explicit State(ChildCommand command)
        : command_(std::move(command)),
          log_(command_.log),
          lines_(command_.onLine),
          outputPipe_(newPipe()),
          output_(outputPipe_.first, [this](std::string_view piece) { lines_.take(piece); }),
          outputOfChild_(outputPipe_.second),
          errorsPipe_(newPipe()),
          errors_(errorsPipe_.first, [this](std::string_view piece) { log_.write(piece); }),
          errorsOfChild_(errorsPipe_.second) {
        std::vector<char*> argv;
        argv.reserve(command_.argv.size() + 1);
        for (const std::string& word : command_.argv) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);

        prctl(PR_SET_CHILD_SUBREAPER, 1);
        before_ = children();
        const pid_t parent = getpid();
        child_ = fork();
        if (child_ < 0) fail("fork");
        if (child_ == 0)
            becomeCommand(argv.data(), outputOfChild_.get(), errorsOfChild_.get(), parent, command_.limits);
        setpgid(child_, child_);  // in both processes, whichever runs first
        outputOfChild_.reset();
        errorsOfChild_.reset();
        running().insert(child_);
        outcome_.timeoutSeconds = command_.timeoutSeconds;
    }
    ~State() {
        if (!isRunning_) return;
        kill(-child_, SIGKILL);
        waitpid(child_, nullptr, 0);
        clear();
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Processes that the child left behind may keep its streams open, or it may close them early: only its exit
    /// counts.
    bool advance(std::chrono::milliseconds atMost) {
        if (!isRunning_) return true;
        std::array<pollfd, 2> watched{output_.watched(), errors_.watched()};
        poll(watched.data(), watched.size(), static_cast<int>(atMost.count()));
        const auto now = Clock::now();
        if (watched[1].revents != 0) errors_.read();
        if (watched[0].revents != 0) {
            output_.read();
            lastSign_ = now;
        } else if (now - lastSign_ > std::chrono::seconds(1)) {
            if (command_.onLine) command_.onLine({});
            lastSign_ = now;
        }
        int status = 0;
        if (waitpid(child_, &status, WNOHANG) == child_) {
            end(status);
            return true;
        }
        if (!killed_) killIfDue(now);
        return false;
    }
    [[nodiscard]] const ChildOutcome& outcome() const { return outcome_; }

 private:
    void killIfDue(Clock::time_point now) {
        if (command_.interrupted && command_.interrupted()) {
            outcome_.end = ChildOutcome::End::interrupted;
            killed_ = true;
        } else if (command_.timeoutSeconds > 0 &&
                   now - start_ > std::chrono::duration<double>(command_.timeoutSeconds)) {
            outcome_.end = ChildOutcome::End::timedOut;
            killed_ = true;
        }
        if (killed_) kill(-child_, SIGKILL);
    }
    void end(int status) {
        kill(-child_, SIGKILL);  // processes that it may have started
        clear();
        output_.readWhatIsThere();
        errors_.readWhatIsThere();
        log_.finish();
        outcome_.lastWords = log_.lastLine();
        if (killed_) return;
        if (WIFSIGNALED(status)) {
            outcome_.end = ChildOutcome::End::killedBySignal;
            outcome_.code = WTERMSIG(status);
        } else {
            outcome_.code = WEXITSTATUS(status);
        }
    }
    void clear() {
        isRunning_ = false;
        running().erase(child_);
        killOrphans(before_);
    }

    ChildCommand command_;
    BoundedLog log_;
    LineSplitter lines_;
    std::pair<int, int> outputPipe_;  // reading end, writing end; owned by the members below
    Stream output_;
    Descriptor outputOfChild_;
    std::pair<int, int> errorsPipe_;
    Stream errors_;
    Descriptor errorsOfChild_;
    std::set<pid_t> before_;
    pid_t child_ = -1;
    bool isRunning_ = true, killed_ = false;
    Clock::time_point start_ = Clock::now(), lastSign_ = start_;
    ChildOutcome outcome_;
};

ChildProcess::ChildProcess(ChildCommand command) : state_(std::make_unique<State>(std::move(command))) {}
ChildProcess::~ChildProcess() = default;

bool ChildProcess::advance(std::chrono::milliseconds atMost) {
    return state_->advance(atMost);
}

const ChildOutcome& ChildProcess::outcome() const {
    return state_->outcome();
}

ChildOutcome runChild(const ChildCommand& command) {
    ChildProcess child(command);
    while (!child.advance(std::chrono::milliseconds(100))) {
    }
    return child.outcome();
}

BoundedLog::BoundedLog(const std::filesystem::path& file) : stream_(file, std::ios::binary | std::ios::trunc) {
    if (!stream_) files::failWriting(file, errno);
}

void BoundedLog::write(std::string_view text) {
    received_ += text.size();
    tail_ += text;
    if (tail_.size() > 2 * tailBytes) tail_.erase(0, tail_.size() - tailBytes);
    const std::string_view fits = text.substr(0, headBytes - std::min<std::uint64_t>(written_, headBytes));
    stream_ << fits << std::flush;
    written_ += fits.size();
}

void BoundedLog::finish() {
    const std::uint64_t missing = received_ - written_;
    const std::size_t end =
        static_cast<std::size_t>(std::min<std::uint64_t>(missing, std::min(tail_.size(), tailBytes)));
    if (missing > end) stream_ << fmt::format("\n[{} bytes left out]\n", missing - end);
    stream_ << std::string_view(tail_).substr(tail_.size() - end) << std::flush;
    written_ = received_;
}

std::string BoundedLog::lastLine() const {
    const std::string_view blank = " \t\r\n";
    const std::size_t last = tail_.find_last_not_of(blank);
    if (last == std::string::npos) return {};
    const std::size_t lineBreak = tail_.find_last_of('\n', last);
    const std::size_t first = lineBreak == std::string::npos ? 0 : lineBreak + 1;
    return tail_.substr(first, std::min<std::size_t>(last + 1 - first, 500));
}

}  // namespace dustbench::run
