// How much memory the process holds, as the kernel counts it.
#pragma once

#include <cstdint>

namespace dustbench::bench {

/// Resident set of this process now, bytes.
[[nodiscard]] std::int64_t residentBytes();

/// Largest resident set of this process so far, bytes.
[[nodiscard]] std::int64_t peakResidentBytes();

}  // namespace dustbench::bench
