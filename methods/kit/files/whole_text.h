// Reads a regular file into memory, within a limit (limits.h).
//
// Refuses pipes, devices and folders without waiting for them. The limit `maximumBytes` is checked before anything is
// allocated and again while reading, because files in /proc report a size of 0.
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

/// `expected` ends the message: `a TOML file`. Throws InputError with the file and the reason, or MachineError as
/// refusalOf does.
[[nodiscard]] DUSTBENCH_API std::string wholeText(const std::filesystem::path& file, std::string_view expected,
                                                  std::uintmax_t maximumBytes = limits::textBytes);

}  // namespace dustbench::files
