#include "bench/suite/tried_in_child.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace dustbench::bench {
namespace {

constexpr unsigned patienceSeconds = 60;

/// A temporary file without a name. Owns: its descriptor.
class Note {
 public:
    explicit Note(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
    }
    ~Note() { close(descriptor_); }
    Note(const Note&) = delete;
    Note& operator=(const Note&) = delete;

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] bool write(const std::string& text) const {
        return ::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
    /// Its first 64 KiB.
    [[nodiscard]] std::string text() const {
        std::string text(1 << 16, '\0');
        const ssize_t got = pread(descriptor_, text.data(), text.size(), 0);
        text.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
        return text;
    }

 private:
    int descriptor_;
};

std::string lastLine(std::string text) {
    text.erase(text.find_last_not_of(" \n") + 1);
    const std::size_t before = text.rfind('\n');
    return before == std::string::npos ? text : text.substr(before + 1);
}

std::string howItEnded(int status, const std::string& errors) {
    std::string text = WIFSIGNALED(status)
                           ? fmt::format("a process that tried it ended by signal {} ({})", WTERMSIG(status),
                                         strsignal(WTERMSIG(status)))
                           : fmt::format("a process that tried it ended with exit code {}", WEXITSTATUS(status));
    if (const std::string line = lastLine(errors); !line.empty()) text += ": " + line;
    return text;
}

}  // namespace

std::string triedInChild(const std::function<std::string()>& task) {
    constexpr int done = 113;  // no other exit code counts
    const Note result("result"), errors("errors");
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
        alarm(patienceSeconds);
        dup2(errors.descriptor(), STDERR_FILENO);
        dup2(errors.descriptor(), STDOUT_FILENO);
        _exit(result.write(task()) ? done : 1);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == done ? result.text() : howItEnded(status, errors.text());
}

}  // namespace dustbench::bench
