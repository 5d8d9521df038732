#include "methods/kit/octree/brick_partition.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <limits>
#include <numeric>

#include "methods/contract/volume.h"
#include "methods/kit/octree/narrow_keys.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

/// Above depth 8: just enough chunks to keep the threads busy, since each has separate counters. The number of chunks
/// does not affect the order.
constexpr std::size_t chunksPerThread = 4;
constexpr std::size_t minimumChunk = 16'384;
/// Up to depth 8: a chunk's keys, ranks and words, 14 bytes per particle, stay in one core's second-level cache until
/// all are placed. Chunks are smaller if there are few particles, so that every thread gets some.
constexpr std::size_t narrowChunksPerThread = 2, minimumNarrowChunk = 8192, maximumNarrowChunk = 65'536;
static_assert(maximumNarrowChunk - 1 <= std::numeric_limits<std::uint16_t>::max(), "ranks have 16 bits");
/// Particles whose words the vector units compute at once, before they are counted.
constexpr std::size_t brickStrip = 1024;
/// Bins whose counts are summed over all chunks at once.
constexpr std::size_t binBlock = 512;
constexpr std::uint32_t wideDigit = 4095;
constexpr int wideIndexBits = 24;
constexpr std::uint64_t wideIndexMask = (1u << wideIndexBits) - 1;
/// With at least this many index bits, at most 32 bits remain for the priority.
constexpr int minimumIndexBits = 32 - brickPlaceBits;

/// Counts a strip's bins and returns each particle's rank within its bin. Prefetches the cache lines of the output.
void rankInBins(std::span<const std::uint32_t> keys, const std::uint64_t* target, std::uint32_t* __restrict counts,
                std::uint16_t* __restrict ranks) {
    constexpr std::size_t lineWords = 8;
    for (std::size_t i = 0; i < keys.size(); i += lineWords) {
        __builtin_prefetch(target + i, 1);
        const std::size_t end = std::min(i + lineWords, keys.size());
        for (std::size_t k = i; k < end; ++k) ranks[k] = static_cast<std::uint16_t>(counts[narrowBin(keys[k])]++);
    }
}

/// Writes each particle's word to its position in its bin.
void scatter(std::span<const std::uint32_t> keys, const std::uint16_t* ranks, const std::uint32_t* starts,
             std::uint32_t firstParticle, BrickKey word, VoxelRule rule, std::uint64_t* sorted) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::uint32_t particle = firstParticle + static_cast<std::uint32_t>(i);
        sorted[starts[narrowBin(keys[i])] + ranks[i]] =
            word.make(rule.priority(particle), narrowPlace(keys[i]), particle);
        asm volatile("");  // prevents vectorisation: scattering a whole vector is slower
    }
}

}  // namespace

BrickPartition::BrickPartition(MemoryLedger& ledger)
    : wideKeys_(ledger.account("octree bricks")),
      wideScratch_(ledger.account("octree bricks")),
      sorted_(ledger.account("octree bricks")),
      ends_(ledger.account("octree bricks")),
      counts_(ledger.account("octree bricks")),
      binSums_(ledger.account("octree bricks")),
      bricks_(ledger.account("octree bricks")),
      upper_(ledger.account("octree bricks")) {}

void BrickPartition::sort(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                          const VoxelRule& voxelRule) {
    checkCount(store);
    key_.indexBits = std::max(static_cast<int>(std::bit_width(store.size())), minimumIndexBits);
    const auto sortBy = [&](const auto& kernel) {
        if (lattice.depth > narrowDepth)
            sortWide(store, kernel, voxelRule);
        else
            sortNarrow(store, kernel, voxelRule, lattice.depth);
    };
    if (settings.levelRule == LevelRule::age)
        sortBy(CellKernel<LevelRule::age>(store, lattice, settings));
    else
        sortBy(CellKernel<LevelRule::radius>(store, lattice, settings));
}

void BrickPartition::setChunks(std::size_t count, std::uint32_t bins) {
    const std::size_t wanted = chunksPerThread * parallel::threadCount();
    chunkSize_ = std::max((count + wanted - 1) / wanted, minimumChunk);
    chunks_ = (count + chunkSize_ - 1) / chunkSize_;
    bins_ = bins;
    counts_.hold(chunks_ * bins_);
    binSums_.hold(bins_ + 1);
}

/// Converts counts to start positions. Proceeds chunk by chunk over all bins, which vectorises.
void BrickPartition::startBins() {
    std::uint32_t* const starts = binSums_.data();
    std::fill_n(starts, bins_ + 1, 0u);
    for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
        std::uint32_t* const counts = counts_.data() + chunk * bins_;
        for (std::uint32_t bin = 0; bin < bins_; ++bin) {
            const std::uint32_t before = starts[bin];
            starts[bin] += counts[bin];
            counts[bin] = before;
        }
    }
    std::exclusive_scan(starts, starts + bins_ + 1, starts, 0u);
    for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
        std::uint32_t* const counts = counts_.data() + chunk * bins_;
        for (std::uint32_t bin = 0; bin < bins_; ++bin) counts[bin] += starts[bin];
    }
}

/// Reserves a row of ends for each chunk. Rows are an odd number of cache lines apart, so that the ends of one bin in
/// all rows map to different cache sets.
std::uint32_t* BrickPartition::holdRuns(std::size_t runs, std::uint32_t bins) {
    runs_ = runs;
    constexpr std::size_t lineEnds = 16;
    runStride_ = ((bins + lineEnds) / lineEnds | 1) * lineEnds;
    return ends_.hold(runs_ * runStride_);
}

/// A stable counting sort by brick in each chunk. Two further bins hold voxels above the bricks and particles outside
/// the world.
template <LevelRule rule>
void BrickPartition::sortNarrow(const Puffs& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule,
                                int depth) {
    const std::size_t total = store.size();
    const std::uint32_t brickBins = 1u << 3 * (depth - brickRise), bins = brickBins + 2;
    std::atomic<bool> allNumbers = true;
    const std::size_t wanted = narrowChunksPerThread * parallel::threadCount();
    const std::size_t chunk = std::clamp((total + wanted - 1) / wanted, minimumNarrowChunk, maximumNarrowChunk);
    std::uint32_t* const ends = holdRuns((total + chunk - 1) / chunk, bins);
    std::uint64_t* const sorted = sorted_.hold(total);

    parallel::forEachBlock(total, chunk, [&](std::size_t first, std::size_t count) {
        std::array<std::uint32_t, maximumNarrowChunk> keys;
        std::array<std::uint16_t, maximumNarrowChunk> ranks;
        std::uint32_t* const starts = ends + first / chunk * runStride_;
        std::fill_n(starts, bins + 1, 0u);
        for (std::size_t strip = 0; strip < count; strip += brickStrip) {
            const std::size_t here = std::min(brickStrip, count - strip);
            makeNarrowKeys(kernel, first + strip, here, brickBins, keys.data() + strip);
            rankInBins({keys.data() + strip, here}, sorted + first + strip, starts, ranks.data() + strip);
        }
        std::exclusive_scan(starts, starts + bins + 1, starts, static_cast<std::uint32_t>(first));
        scatter({keys.data(), count}, ranks.data(), starts, static_cast<std::uint32_t>(first), key_, voxelRule, sorted);
        // Particles with NaN positions count as outside the world.
        for (std::uint32_t i = starts[brickBins + 1]; i < starts[bins]; ++i)
            if (!isNumber(store, key_.particle(sorted[i]))) allNumbers = false;
    });

    std::uint32_t* const sums = binSums_.hold(bins);
    parallel::forEachBlock(bins, binBlock, [&](std::size_t first, std::size_t count) {
        std::fill_n(sums + first, count, 0u);
        for (std::size_t run = 0; run < runs_; ++run) {
            const std::uint32_t* const starts = ends + run * runStride_ + first;
            for (std::size_t i = 0; i < count; ++i) sums[first + i] += starts[i + 1] - starts[i];
        }
    });
    Brick* const bricks = bricks_.hold(brickBins);
    std::size_t brickCount = 0;
    std::uint32_t before = 0;
    for (std::uint32_t bin = 0; bin < brickBins; ++bin) {
        bricks[brickCount] = {std::uint64_t{bin} << 3 * brickRise, before, sums[bin], bin};
        brickCount += sums[bin] > 0 ? 1 : 0;
        before += sums[bin];
    }
    brickCount_ = brickCount;
    sortedCount_ = before;
    collectUpper({.count = sums[brickBins], .bin = brickBins}, kernel);
    clipped_ = static_cast<std::int64_t>(sums[brickBins + 1]);
    if (!allNumbers) checkPositions(store);
}

/// Two stable counting sorts, by the lower and by the upper twelve bits of the brick code.
template <LevelRule rule>
void BrickPartition::sortWide(const Puffs& store, const CellKernel<rule>& kernel, const VoxelRule& voxelRule) {
    constexpr std::uint64_t aboveBricks = 1u << 24, outside = aboveBricks + 1;
    const std::size_t total = store.size();
    std::uint64_t* const keys = wideKeys_.hold(total);
    std::uint64_t* const scratch = wideScratch_.hold(total);
    parallel::forEachBlock(total, minimumChunk, [&](std::size_t first, std::size_t count) {
        const CellKernel<rule> cellOf = kernel;
        for (std::size_t i = first; i < first + count; ++i) {
            const ParticleCell cell = cellOf(i);
            const std::uint64_t inTree = cell.aboveBricks ? aboveBricks : cell.brickCode;
            const std::uint64_t brick = cell.outside ? outside : inTree;
            keys[i] = (brick << brickPlaceBits | placeInBrick(cell.localCode, cell.rise)) << wideIndexBits | i;
        }
    });
    const int brickShift = wideIndexBits + brickPlaceBits;
    scatterWide(keys, scratch, total, brickShift, wideDigit);
    scatterWide(scratch, keys, total, brickShift + 12, 2 * wideDigit + 1);

    std::uint64_t* const sorted = sorted_.hold(total);
    parallel::forEachBlock(total, minimumChunk, [&, word = key_](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto particle = static_cast<std::uint32_t>(keys[i] & wideIndexMask);
            const std::uint32_t place =
                static_cast<std::uint32_t>(keys[i] >> wideIndexBits) & ((1u << brickPlaceBits) - 1);
            sorted[i] = word.make(voxelRule.priority(particle), place, particle);
        }
    });

    Brick* const bricks = bricks_.hold(total);
    std::uint32_t* const starts = holdRuns(1, static_cast<std::uint32_t>(total) + 1);
    std::uint32_t count = 0, i = 0;
    std::uint64_t last = outside;
    for (; i < total && keys[i] >> brickShift < aboveBricks; ++i) {
        const std::uint64_t brick = keys[i] >> brickShift;
        if (brick != last) {
            starts[count] = i;
            bricks[count] = {brick << 3 * brickRise, i, 0, count};
            ++count;
        }
        ++bricks[count - 1].count;
        last = brick;
    }
    brickCount_ = count;
    sortedCount_ = starts[count] = i;
    while (i < total && keys[i] >> brickShift == aboveBricks) ++i;
    starts[count + 1] = i;
    collectUpper({.count = i - starts[count], .bin = count}, kernel);
    clipped_ = static_cast<std::int64_t>(total - i);
    if (clipped_ > 0) checkPositions(store);
}

void BrickPartition::scatterWide(const std::uint64_t* from, std::uint64_t* to, std::size_t count, int shift,
                                 std::uint32_t mask) {
    setChunks(count, mask + 1);
    std::uint32_t* const counts = counts_.data();
    const auto digitOf = [shift, mask](std::uint64_t key) { return static_cast<std::uint32_t>(key >> shift) & mask; };
    parallel::forEachBlock(count, chunkSize_, [&](std::size_t first, std::size_t length) {
        std::uint32_t* const mine = counts + first / chunkSize_ * bins_;
        std::fill_n(mine, bins_, 0u);
        for (std::size_t i = first; i < first + length; ++i) ++mine[digitOf(from[i])];
    });
    startBins();
    parallel::forEachBlock(count, chunkSize_, [&](std::size_t first, std::size_t length) {
        std::uint32_t* const next = counts + first / chunkSize_ * bins_;
        for (std::size_t i = first; i < first + length; ++i) to[next[digitOf(from[i])]++] = from[i];
    });
}

/// Collects particles above the bricks as entries of the whole tree.
template <LevelRule rule>
void BrickPartition::collectUpper(const Brick& above, const CellKernel<rule>& kernel) {
    CellEntry* upper = upper_.hold(above.count);
    upperCount_ = above.count;
    forEachParticle(above, [&](std::uint64_t word) {
        const std::uint32_t particle = key_.particle(word);
        const ParticleCell cell = kernel(particle);
        const std::uint64_t code = static_cast<std::uint64_t>(cell.brickCode) << 3 * brickRise | cell.localCode;
        *upper++ = CellEntry(code, static_cast<int>(cell.rise), particle);
    });
}

}  // namespace dustbench::octree
