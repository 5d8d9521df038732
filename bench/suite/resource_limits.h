// Resource limits of the process of a run.
#pragma once

#include <cstdint>

namespace dustbench::suite {

/// 0: no limit.
struct ResourceLimits {
    std::int64_t memoryMegabytes = 0;  ///< private writable memory, in units of 10^6 bytes
    std::int64_t cpuSeconds = 0;       ///< of all its threads together
};

}  // namespace dustbench::suite
