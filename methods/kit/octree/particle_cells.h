// The list of active particles, the first step of a faithful build: each particle's cell and level in one packed word.
//
// Threads: parallel over fixed blocks; the result does not depend on the number of threads.
// Source: Carr2006, 3.3 and 3.4, step 1.
#pragma once

#include <cstdint>
#include <span>

#include "methods/contract/volume.h"
#include "methods/kit/octree/cell_entry.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/octree/reused_array.h"

namespace dustbench::octree {

/// Entries in store order. Particles outside the world have no entry, but are counted.
class DUSTBENCH_API ParticleCells {
 public:
    explicit ParticleCells(MemoryLedger& ledger);

    /// Throws like `checkPositions` and `checkCount` (cell_kernel.h).
    void find(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

    [[nodiscard]] std::span<const CellEntry> entries() const { return {entries_.data(), count_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    template <LevelRule rule>
    void fill(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

    ReusedArray<CellEntry> entries_;
    ReusedArray<std::uint32_t> blockSizes_;
    std::size_t count_ = 0;
    std::int64_t clipped_ = 0;
};

}  // namespace dustbench::octree
