#include "methods/kit/files/whole_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::files {
namespace {

/// Throws MachineError if the cause is the machine, not the file.
std::string systemReason(const std::filesystem::path& file) {
    const std::string reason = fmt::format("cannot be read: {}", std::generic_category().message(errno));
    if (isShortage(errno)) throw MachineError(fmt::format("{} {}", file.string(), reason));
    return reason;
}

std::string tooLong(std::uintmax_t maximumBytes) {
    return fmt::format("is too large, allowed: {} MB (limit of such files)", maximumBytes / 1'000'000);
}

std::string kindOf(mode_t mode) {
    if (S_ISDIR(mode)) return "is a folder";
    if (S_ISFIFO(mode) || S_ISSOCK(mode)) return "is a pipe, allowed: regular files only";
    return "is a device, allowed: regular files only";
}

/// Owns: an open file. Opening a pipe does not wait for its writer.
class OpenFile {
 public:
    explicit OpenFile(const std::filesystem::path& file)
        : file_(file), handle_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
    ~OpenFile() {
        if (handle_ >= 0) close(handle_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    [[nodiscard]] std::string refusal(std::uintmax_t maximumBytes) const {
        struct stat facts {};
        if (handle_ < 0 || fstat(handle_, &facts) != 0) return systemReason(file_);
        if (!S_ISREG(facts.st_mode)) return kindOf(facts.st_mode);
        return static_cast<std::uintmax_t>(facts.st_size) > maximumBytes ? tooLong(maximumBytes) : "";
    }
    /// Empty on success, else the reason.
    [[nodiscard]] std::string readInto(std::string& text, std::uintmax_t maximumBytes) const {
        std::array<char, 1 << 16> block{};
        for (;;) {
            const ssize_t bytes = read(handle_, block.data(), block.size());
            if (bytes == 0) return "";
            if (bytes < 0 && errno == EINTR) continue;
            if (bytes < 0) return systemReason(file_);
            if (text.size() + static_cast<std::size_t>(bytes) > maximumBytes) return tooLong(maximumBytes);
            text.append(block.data(), static_cast<std::size_t>(bytes));
        }
    }

 private:
    const std::filesystem::path& file_;
    int handle_;
};

}  // namespace

std::string refusalOf(const std::filesystem::path& file, std::uintmax_t maximumBytes) {
    // Opening some devices has side effects, so check the kind first.
    struct stat facts {};
    if (stat(file.c_str(), &facts) != 0) return systemReason(file);
    if (!S_ISREG(facts.st_mode)) return kindOf(facts.st_mode);
    return OpenFile(file).refusal(maximumBytes);
}

std::string wholeText(const std::filesystem::path& file, std::string_view expected, std::uintmax_t maximumBytes) {
    std::string text, reason = refusalOf(file, maximumBytes);
    if (reason.empty()) {
        const OpenFile open(file);
        reason = open.refusal(maximumBytes);
        if (reason.empty()) reason = open.readInto(text, maximumBytes);
    }
    if (!reason.empty()) throw InputError(fmt::format("{}: {}, expected {}", file.string(), reason, expected));
    return text;
}

}  // namespace dustbench::files
