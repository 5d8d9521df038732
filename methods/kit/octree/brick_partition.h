// Sorts particles into bricks, in the store's order within each brick.
//
// Up to depth 8 each chunk of the store is sorted separately, in a size that fits the cache of one core; a brick's
// particles then form a run in each chunk. At greater depths there are too many bricks to count in each chunk, and all
// particles are sorted at once, as one chunk.
//
// Owns: its working memory, booked on a ledger and kept between frames. Threads: parallel over fixed chunks of the
// store; the result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <span>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

/// One brick that contains particles.
struct Brick {
    std::uint64_t code = 0;              ///< Morton code of its first finest cell
    std::uint32_t first = 0, count = 0;  ///< its range among the particles of all bricks
    std::uint32_t bin = 0;               ///< index of its runs
};

/// The voxel at a place in a brick.
[[nodiscard]] inline CellEntry voxelAt(const Brick& brick, std::uint32_t place, std::uint32_t particle) {
    return CellEntry(brick.code << 28 | std::uint64_t{codeAndRiseOfPlace[place]} << 24 | particle);
}

/// Packs a sorted particle into one word: leading bits of its priority, its place in the brick, its index. Of two
/// particles in one cell, the one with the higher word wins, unless the leading bits are equal.
struct BrickKey {
    int indexBits = 24;  ///< enough for the number of particles

    [[nodiscard]] std::uint64_t make(std::uint32_t priority, std::uint32_t place, std::uint32_t particle) const {
        const std::uint64_t first = priority >> (brickPlaceBits + indexBits - 32);
        return (first << brickPlaceBits | place) << indexBits | particle;
    }
    [[nodiscard]] std::uint32_t place(std::uint64_t key) const {
        return static_cast<std::uint32_t>(key >> indexBits) & ((1u << brickPlaceBits) - 1);
    }
    [[nodiscard]] std::uint32_t particle(std::uint64_t key) const {
        return static_cast<std::uint32_t>(key) & ((1u << indexBits) - 1);
    }
    [[nodiscard]] bool samePriority(std::uint64_t a, std::uint64_t b) const {
        return (a ^ b) >> (brickPlaceBits + indexBits) == 0;
    }
};

class DUSTBENCH_API BrickPartition {
 public:
    explicit BrickPartition(MemoryLedger& ledger);

    /// Throws like `checkPositions` and `checkCount` (cell_kernel.h).
    void sort(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings, const VoxelRule& voxelRule);

    /// In Morton order.
    [[nodiscard]] std::span<const Brick> bricks() const { return {bricks_.data(), brickCount_}; }
    /// Number of particles in all bricks.
    [[nodiscard]] std::size_t size() const { return sortedCount_; }
    /// Calls `visit(word)` for each particle of a brick, in store order; words are packed as by `key()`.
    template <typename Visit>
    void forEachParticle(const Brick& brick, const Visit& visit) const {
        if (runs_ == 0) return;  // no particles, no memory yet
        const std::uint32_t* ends = ends_.data() + brick.bin;
        for (std::size_t run = 0; run < runs_; ++run, ends += runStride_) {
            const std::uint64_t* const end = sorted_.data() + ends[1];
            // The next brick's run starts here.
            __builtin_prefetch(end);
            __builtin_prefetch(end + 8);
            __builtin_prefetch(ends + 16);
            for (const std::uint64_t* particle = sorted_.data() + ends[0]; particle < end; ++particle) visit(*particle);
        }
    }
    [[nodiscard]] const BrickKey& key() const { return key_; }

    /// Particles whose voxels are larger than a brick, in store order.
    [[nodiscard]] std::span<CellEntry> upper() { return {upper_.data(), upperCount_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    template <LevelRule rule>
    void sortNarrow(const Puffs& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule, int depth);
    template <LevelRule rule>
    void sortWide(const Puffs& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule);
    template <LevelRule rule>
    void collectUpper(const Brick& above, const CellKernel<rule>& kernel);
    void setChunks(std::size_t count, std::uint32_t bins);
    void startBins();
    void scatterWide(const std::uint64_t* from, std::uint64_t* to, std::size_t count, int shift, std::uint32_t mask);
    std::uint32_t* holdRuns(std::size_t runs, std::uint32_t bins);

    ReusedArray<std::uint64_t> wideKeys_, wideScratch_;  ///< brick, place, index
    ReusedArray<std::uint64_t> sorted_;
    ReusedArray<std::uint32_t> ends_;     ///< by chunk and bin: start of the bin's run; the next entry is its end
    ReusedArray<std::uint32_t> counts_;   ///< by chunk and bin: count, then position of the next particle
    ReusedArray<std::uint32_t> binSums_;  ///< over all chunks
    ReusedArray<Brick> bricks_;
    ReusedArray<CellEntry> upper_;
    BrickKey key_;
    std::uint32_t bins_ = 0;
    std::size_t runs_ = 0, runStride_ = 0;
    std::size_t chunks_ = 0, chunkSize_ = 0, brickCount_ = 0, sortedCount_ = 0, upperCount_ = 0;
    std::int64_t clipped_ = 0;
};

}  // namespace dustbench::octree
