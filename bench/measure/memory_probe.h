// How much memory the process holds and how much more it could have, as the kernel counts it.
#pragma once

#include <cstdint>

namespace dustbench::bench {

/// Resident set of this process now, bytes.
[[nodiscard]] std::int64_t residentBytes();

/// Largest resident set of this process so far, bytes.
[[nodiscard]] std::int64_t peakResidentBytes();

/// What can still be allocated without swapping (`MemAvailable`), or within the process's own limit (`ulimit -v`).
[[nodiscard]] std::int64_t availableBytes();

}  // namespace dustbench::bench
