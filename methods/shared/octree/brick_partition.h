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

namespace dustbench::octree {

/// One brick that holds particles.
struct Brick {
    std::uint64_t code = 0;              ///< Morton code of its first finest cell
    std::uint32_t first = 0, count = 0;  ///< its particles among all sorted ones
};

class BrickPartition {
 public:
    explicit BrickPartition(MemoryLedger& ledger);

    /// Throws as `checkPositions` and `checkCount` do (cell_kernel.h).
    void sort(const particles::ParticleStore& store, const Lattice& lattice, const OctreeSettings& settings);

    /// In Morton order.
    [[nodiscard]] std::span<const Brick> bricks() const { return {bricks_.data(), brickCount_}; }
    /// Particles in all bricks.
    [[nodiscard]] std::size_t size() const { return sortedCount_; }
    /// Calls `visit(location, particle)` for the particles of a brick, in the order of the store. It will look into the
    /// column `wanted`, which is fetched ahead.
    template <typename Visit>
    void visitParticles(const Brick& brick, const float* wanted, const Visit& visit) const {
        if (wide_) {
            for (std::uint32_t i = brick.first; i < brick.first + brick.count; ++i)
                visit(static_cast<std::uint32_t>(wideSorted_.data()[i] >> wideIndexBits) & (brickCodes - 1),
                      static_cast<std::uint32_t>(wideSorted_.data()[i] & wideIndexMask));
            return;
        }
        const std::uint32_t* const sorted = narrowSorted_.data();
        const std::uint32_t* const ends = counts_.data() + (brick.code >> 3 * brickRise);
        std::uint32_t i = brick.first;
        for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
            const std::uint32_t end = ends[chunk * bins_];
            const auto base = static_cast<std::uint32_t>(chunk * chunkSize_);
            for (; i < end; ++i) {
                __builtin_prefetch(wanted + base + (sorted[i + ahead] & indexMask));
                visit(sorted[i] >> indexBits, base + (sorted[i] & indexMask));
            }
        }
    }

    /// Particles whose voxels are larger than a brick, in the order of the store.
    [[nodiscard]] std::span<CellEntry> upper() { return {upper_.data(), upperCount_}; }
    [[nodiscard]] std::int64_t clipped() const { return clipped_; }

 private:
    // Up to depth 8 a particle is one 32-bit word: location code, and index counted from its chunk's beginning.
    static constexpr int indexBits = 32 - brickCodeBits;
    static constexpr std::uint32_t indexMask = (1u << indexBits) - 1;
    /// How many particles ahead their memory is fetched.
    static constexpr std::size_t ahead = 16;
    // Deeper, it is 64 bits: brick, location code, index.
    static constexpr int wideIndexBits = 24;
    static constexpr std::uint64_t wideIndexMask = (1u << wideIndexBits) - 1;

    template <LevelRule rule>
    void sortNarrow(const particles::ParticleStore& store, const CellKernel<rule>& kernel, int depth);
    template <LevelRule rule>
    void sortWide(const particles::ParticleStore& store, const CellKernel<rule>& kernel);
    template <LevelRule rule>
    void collectUpper(const particles::ParticleStore& store, std::size_t first, std::size_t count,
                      const CellKernel<rule>& kernel);
    void setChunks(std::size_t count, std::uint32_t bins);
    void startBins();
    void scatterWide(const std::uint64_t* from, std::uint64_t* to, std::size_t count, int shift, std::uint32_t mask);

    Room<std::uint32_t> narrowKeys_, narrowSorted_;
    Room<std::uint64_t> wideKeys_, wideSorted_;
    Room<std::uint32_t> counts_;     ///< by chunk and bin: how many, then where the next one goes, in the end the ends
    Room<std::uint32_t> binStarts_;  ///< one more than bins
    Room<Brick> bricks_;
    Room<CellEntry> upper_;
    bool wide_ = false;
    std::uint32_t bins_ = 0;
    std::size_t chunks_ = 0, chunkSize_ = 0, brickCount_ = 0, sortedCount_ = 0, upperCount_ = 0;
    std::int64_t clipped_ = 0;
};

}  // namespace dustbench::octree
