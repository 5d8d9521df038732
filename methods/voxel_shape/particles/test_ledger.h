// A ledger and the usual time step for the tests in this folder.
#pragma once

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::voxel_shape {

inline constexpr float dt = 1.0f / 60;

/// One ledger for the whole program.
inline MemoryLedger& ledger() {
    static MemoryLedger one;
    return one;
}

}  // namespace dustbench::voxel_shape
