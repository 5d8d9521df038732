// Memory held by a method: exact bytes by structure, as counted by kit/memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dustbench {

struct MemoryUse {
    std::string structure;  ///< `voxels`, `particle positions`
    std::size_t cpuBytes = 0;
    std::size_t gpuBytes = 0;
};

using MemoryReport = std::vector<MemoryUse>;

}  // namespace dustbench
