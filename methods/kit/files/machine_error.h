// What the machine lacks: a full disk, a quota, too many open files, no more memory. It is a fault neither of the input
// nor of what is measured.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace dustbench::files {

/// The message is one line: what could not be done, and why. The command ends with exit code 2 (`aborted`) and goes on
/// when it is called again; what it was writing is gone.
class DUSTBENCH_API MachineError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    MachineError(const MachineError&) = default;
    MachineError& operator=(const MachineError&) = default;
    ~MachineError() override;
};

/// Begins the message where memory ran out.
inline constexpr const char* outOfMemory = "out of memory";

/// Whether an error number says so: ENOSPC, EDQUOT, EIO, EFBIG, EMFILE, ENFILE, ENOMEM.
[[nodiscard]] DUSTBENCH_API bool isOfMachine(int error);
/// Those of them that say nothing of the file that is read: all but EIO, which is damage of that file.
[[nodiscard]] DUSTBENCH_API bool isShortage(int error);

/// `output 'a/b' cannot be written: No space left on device`: MachineError if the error number says so, else
/// InputError.
[[noreturn]] DUSTBENCH_API void failWriting(const std::filesystem::path& path, int error);

}  // namespace dustbench::files
