// Reads a regular file into memory, within a limit (limits.h).
//
// A pipe, a device or a folder is refused and never waited for. What is at most `maximumBytes` long is decided before
// anything is allocated, and again while reading, because files in /proc say that they are empty.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "methods/kit/files/limits.h"

namespace dustbench::files {

/// Empty if the file can be read and is within the limit, else the reason as one clause: `is a folder`, `cannot be
/// read: No such file or directory`.
[[nodiscard]] DUSTBENCH_API std::string refusalOf(const std::filesystem::path& file,
                                                  std::uintmax_t maximumBytes = limits::textBytes);

/// `expected` ends the message: `a TOML file`. Throws InputError with the file and the reason; as refusalOf,
/// MachineError if it is the machine that cannot read it.
[[nodiscard]] DUSTBENCH_API std::string wholeText(const std::filesystem::path& file, std::string_view expected,
                                                  std::uintmax_t maximumBytes = limits::textBytes);

}  // namespace dustbench::files
