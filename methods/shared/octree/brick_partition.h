// Sorts particles into bricks, keeping the order of the store inside each.
//
// Owns: its working memory, on a ledger, kept from frame to frame. Threads: parallel over fixed chunks of the store;
// the same result at any number of threads.
#pragma once

#include <cstdint>
#include <span>

#include "methods/shared/octree/brick_nodes.h"
#include "methods/shared/octree/cell_entry.h"
#include "methods/shared/octree/cell_kernel.h"
#include "methods/shared/octree/room.h"
#include "methods/shared/octree/voxel_rule.h"

namespace dustbench::octree {

/// One brick that holds particles.
struct Brick {
    std::uint64_t code = 0;              ///< Morton code of its first finest cell
    std::uint32_t first = 0, count = 0;  ///< its particles among all sorted ones
};

/// How a sorted particle is one word: the first bits of its priority, its location code in the brick, its index. Of
/// two particles in one cell the one with the higher word wins, unless their first bits are equal.
struct BrickKey {
    int indexBits = 24;  ///< enough for all particles

    [[nodiscard]] std::uint64_t make(std::uint32_t priority, std::uint32_t location, std::uint32_t particle) const {
        const std::uint64_t first = priority >> (brickCodeBits + indexBits - 32);
        return (first << brickCodeBits | location) << indexBits | particle;
    }
    [[nodiscard]] std::uint32_t location(std::uint64_t key) const {
        return static_cast<std::uint32_t>(key >> indexBits) & (brickCodes - 1);
    }
    [[nodiscard]] std::uint32_t particle(std::uint64_t key) const {
        return static_cast<std::uint32_t>(key) & ((1u << indexBits) - 1);
    }
    [[nodiscard]] bool samePriority(std::uint64_t a, std::uint64_t b) const {
        return (a ^ b) >> (brickCodeBits + indexBits) == 0;
    }
};

class BrickPartition {
 public:
    explicit BrickPartition(MemoryLedger& ledger);

    /// Throws as `checkPosition` and `checkCount` do (cell_kernel.h).
    void sort(const particles::ParticleStore& store, const Lattice& lattice, const OctreeSettings& settings,
              const VoxelRule& voxelRule);

    /// In Morton order.
    [[nodiscard]] std::span<const Brick> bricks() const { return {bricks_.data(), brickCount_}; }
    /// Particles in all bricks.
    [[nodiscard]] std::size_t size() const { return sortedCount_; }
    /// The particles of a brick, in the order of the store, as `key()` has them.
    [[nodiscard]] std::span<const std::uint64_t> particles(const Brick& brick) const {
        return {sorted_.data() + brick.first, brick.count};
    }
    [[nodiscard]] const BrickKey& key() const { return key_; }

    /// Particles whose voxels are larger than a brick, in the order of the store.
    [[nodiscard]] std::span<CellEntry> upper() { return {upper_.data(), upperCount_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    template <LevelRule rule>
    void sortNarrow(const particles::ParticleStore& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule,
                    int depth);
    template <LevelRule rule>
    void sortWide(const particles::ParticleStore& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule);
    template <LevelRule rule>
    void collectUpper(std::span<const std::uint64_t> above, const CellKernel<rule>& kernel);
    void leaveOut(std::span<const std::uint64_t> outside, const particles::ParticleStore& store);
    void setChunks(std::size_t count, std::uint32_t bins);
    void startBins();
    void scatterWide(const std::uint64_t* from, std::uint64_t* to, std::size_t count, int shift, std::uint32_t mask);

    Room<std::uint32_t> narrowKeys_;              ///< up to depth 8: bin, location code
    Room<std::uint64_t> wideKeys_, wideScratch_;  ///< deeper: brick, location code, index
    Room<std::uint64_t> sorted_;
    Room<std::uint32_t> counts_;     ///< by chunk and bin: how many, then where the next one goes
    Room<std::uint32_t> binStarts_;  ///< one more than bins
    Room<Brick> bricks_;
    Room<CellEntry> upper_;
    BrickKey key_;
    std::uint32_t bins_ = 0;
    std::size_t chunks_ = 0, chunkSize_ = 0, brickCount_ = 0, sortedCount_ = 0, upperCount_ = 0;
    std::int64_t clipped_ = 0;
};

}  // namespace dustbench::octree
