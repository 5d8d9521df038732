// Memory use of this process, as counted by the kernel.
#pragma once

#include <cstdint>

namespace dustbench::measure {

/// Current resident set size, in bytes.
[[nodiscard]] std::int64_t residentBytes();

/// Peak resident set size so far, in bytes.
[[nodiscard]] std::int64_t peakResidentBytes();

}  // namespace dustbench::measure
