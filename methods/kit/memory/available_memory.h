// How much more memory this process could have, as the kernel counts it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dustbench {

/// What can still be allocated without swapping (`MemAvailable`), or within the process's own limit (`ulimit -v`).
[[nodiscard]] DUSTBENCH_API std::int64_t availableBytes();

/// `structure` as a message names it. Throws InputError with both numbers where `bytes` more are not available.
DUSTBENCH_API void requireAvailable(std::string_view structure, std::size_t bytes);

/// A line `NAME: 123 kB` of one of the kernel's files, such as /proc/meminfo; nothing where it has none.
[[nodiscard]] DUSTBENCH_API std::optional<std::int64_t> bytesInKernelFile(const char* file, std::string_view name);

}  // namespace dustbench
