// What the process of a run may use.
#pragma once

#include <cstdint>

namespace dustbench::bench {

/// 0: no limit.
struct ResourceLimits {
    std::int64_t memoryMegabytes = 0;  ///< private memory that can be written, in units of 10^6 bytes
    std::int64_t cpuSeconds = 0;       ///< of all its threads together
};

}  // namespace dustbench::bench
