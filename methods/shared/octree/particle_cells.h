// The list of active particles with which a faithful build begins: each particle's cell and level, as one packed word.
//
// Threads: parallel over fixed blocks; the same result at any number of threads.
// Source: Carr2006, 3.3 and 3.4, step 1.
#pragma once

#include <cstdint>
#include <span>

#include "methods/shared/octree/cell_entry.h"
#include "methods/shared/octree/lattice.h"
#include "methods/shared/octree/octree_settings.h"
#include "methods/shared/octree/room.h"
#include "methods/shared/particles/particle_store.h"

namespace dustbench::octree {

/// Entries in the order of the store, without the particles outside the world, which are counted.
class ParticleCells {
 public:
    explicit ParticleCells(MemoryLedger& ledger);

    /// Throws as `checkPositions` and `checkCount` do (cell_kernel.h).
    void find(const particles::ParticleStore& store, const Lattice& lattice, const OctreeSettings& settings);

    [[nodiscard]] std::span<const CellEntry> entries() const { return {entries_.data(), count_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    template <LevelRule rule>
    void fill(const particles::ParticleStore& store, const Lattice& lattice, const OctreeSettings& settings);

    Room<CellEntry> entries_;
    Room<std::uint32_t> blockSizes_;
    std::size_t count_ = 0;
    std::int64_t clipped_ = 0;
};

}  // namespace dustbench::octree
