// Errors due to a lack of resources: a full disk, a quota, too many open files, no memory. Neither the input nor the
// measured method is at fault.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace dustbench::files {

/// The message is one line: the failed action and the reason. The command ends with exit code 2 (`aborted`) and can be
/// called again to continue; partial output is removed.
class DUSTBENCH_API MachineError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
    MachineError(const MachineError&) = default;
    MachineError& operator=(const MachineError&) = default;
    ~MachineError() override;
};

/// Start of the message if memory ran out.
inline constexpr const char* outOfMemory = "out of memory";

/// True for error numbers of this kind: ENOSPC, EDQUOT, EIO, EFBIG, EMFILE, ENFILE, ENOMEM.
[[nodiscard]] DUSTBENCH_API bool isOfMachine(int error);
/// The same without EIO, which means that the file itself is damaged.
[[nodiscard]] DUSTBENCH_API bool isShortage(int error);

/// `output 'a/b' cannot be written: No space left on device`: throws MachineError if isOfMachine(error), otherwise
/// InputError.
[[noreturn]] DUSTBENCH_API void failWriting(const std::filesystem::path& path, int error);

}  // namespace dustbench::files
