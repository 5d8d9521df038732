// How much more memory this process can allocate, as reported by the kernel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dustbench {

/// Memory that can be allocated without swapping (`MemAvailable`), or within the process's own limit (`ulimit -v`).
[[nodiscard]] DUSTBENCH_API std::int64_t availableBytes();

/// Throws InputError with both numbers unless `bytes` more are available; `structure` is the name in the message.
DUSTBENCH_API void requireAvailable(std::string_view structure, std::size_t bytes);

/// The value of a line `NAME: 123 kB` in a kernel file such as /proc/meminfo; empty if there is no such line.
[[nodiscard]] DUSTBENCH_API std::optional<std::int64_t> bytesInKernelFile(const char* file, std::string_view name);

}  // namespace dustbench
