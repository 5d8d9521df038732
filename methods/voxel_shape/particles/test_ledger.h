// For the tests of this folder: a ledger for what they make, and the step that most of them take.
#pragma once

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::voxel_shape {

inline constexpr float dt = 1.0f / 60;

/// One for the whole program.
inline MemoryLedger& ledger() {
    static MemoryLedger one;
    return one;
}

}  // namespace dustbench::voxel_shape
