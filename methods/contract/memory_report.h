// What a method says of the memory that it holds: exact bytes by structure. kit/memory counts them.
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
