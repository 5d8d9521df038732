#include "methods/shared/octree/brick_partition.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

/// As few chunks as keep the threads busy: each has counters of its own. The order is the same whatever their number.
constexpr std::size_t chunksPerThread = 4;
constexpr std::size_t leastChunk = 16'384;
/// Particles whose words are made at once, by the vector units, before they are counted.
constexpr std::size_t stripSize = 1024;
/// So many places before a bin comes to one, its cache line is fetched: two lines, for a line may be left at once.
constexpr std::size_t ahead = 16;
/// Up to this depth bricks are few enough to be bins.
constexpr int narrowDepth = 8;
constexpr std::uint32_t wideDigit = 4095;
constexpr int wideIndexBits = 24;
constexpr std::uint64_t wideIndexMask = (1u << wideIndexBits) - 1;
/// So many leave no more than 32 bits for the priority.
constexpr int leastIndexBits = 32 - brickCodeBits;

/// A function of its own, so that the compiler sees that the keys lie apart from what they are made of.
template <LevelRule rule>
[[gnu::noinline]] void makeNarrowKeys(const CellKernel<rule>& kernel, std::size_t first, std::size_t count,
                                      std::uint32_t brickBins, std::uint32_t* __restrict keys) {
    const CellKernel<rule> cellOf = kernel;
    for (std::size_t i = 0; i < count; ++i) {
        const ParticleCell cell = cellOf.shallow(first + i);
        const std::uint32_t inTree = (cell.brickCode & ~cell.aboveBricks) | (brickBins & cell.aboveBricks);
        const std::uint32_t bin = (inTree & ~cell.outside) | ((brickBins + 1) & cell.outside);
        keys[i] = bin << brickCodeBits | locationCode(cell.localCode, cell.rise);
    }
}

}  // namespace

BrickPartition::BrickPartition(MemoryLedger& ledger)
    : narrowKeys_(ledger.account("octree bricks")),
      wideKeys_(ledger.account("octree bricks")),
      wideScratch_(ledger.account("octree bricks")),
      sorted_(ledger.account("octree bricks")),
      counts_(ledger.account("octree bricks")),
      binStarts_(ledger.account("octree bricks")),
      bricks_(ledger.account("octree bricks")),
      upper_(ledger.account("octree bricks")) {}

void BrickPartition::sort(const particles::ParticleStore& store, const Lattice& lattice, const OctreeSettings& settings,
                          const VoxelRule& voxelRule) {
    checkCount(store);
    key_.indexBits = std::max(static_cast<int>(std::bit_width(store.size())), leastIndexBits);
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
    chunkSize_ = std::max((count + wanted - 1) / wanted, leastChunk);
    chunks_ = (count + chunkSize_ - 1) / chunkSize_;
    bins_ = bins;
    counts_.hold(chunks_ * bins_);
    binStarts_.hold(bins_ + 1);
}

/// From how many to where the first one goes. Chunk by chunk over all bins, which the vector units take at once.
void BrickPartition::startBins() {
    std::uint32_t* const starts = binStarts_.data();
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

/// One stable counting sort by brick. Two bins more: voxels above the bricks, and particles outside the world.
template <LevelRule rule>
void BrickPartition::sortNarrow(const particles::ParticleStore& store, const CellKernel<rule>& kernel,
                                const VoxelRule& voxelRule, int depth) {
    const std::size_t total = store.size();
    const std::uint32_t brickBins = 1u << 3 * (depth - brickRise);
    setChunks(total, brickBins + 2);
    std::uint32_t* const keys = narrowKeys_.hold(total);
    std::uint64_t* const sorted = sorted_.hold(total);
    std::uint32_t* const counts = counts_.data();
    const BrickKey word = key_;

    parallel::forEachBlock(total, chunkSize_, [&](std::size_t first, std::size_t count) {
        std::uint32_t* const mine = counts + first / chunkSize_ * bins_;
        std::fill_n(mine, bins_, 0u);
        for (std::size_t strip = first; strip < first + count; strip += stripSize) {
            const std::size_t here = std::min(stripSize, first + count - strip);
            makeNarrowKeys(kernel, strip, here, brickBins, keys + strip);
            for (std::size_t i = strip; i < strip + here; ++i) ++mine[keys[i] >> brickCodeBits];
        }
    });
    startBins();
    parallel::forEachBlock(total, chunkSize_, [&](std::size_t first, std::size_t count) {
        std::uint32_t* const next = counts + first / chunkSize_ * bins_;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t key = keys[first + i];
            const auto particle = static_cast<std::uint32_t>(first + i);
            const std::uint32_t place = next[key >> brickCodeBits]++;
            __builtin_prefetch(sorted + place + ahead, 1);
            sorted[place] = word.make(voxelRule.priority(particle), key & (brickCodes - 1), particle);
        }
    });

    const std::uint32_t* const starts = binStarts_.data();
    Brick* const bricks = bricks_.hold(brickBins);
    brickCount_ = 0;
    for (std::uint32_t bin = 0; bin < brickBins; ++bin)
        if (starts[bin + 1] > starts[bin])
            bricks[brickCount_++] = {std::uint64_t{bin} << 3 * brickRise, starts[bin], starts[bin + 1] - starts[bin]};
    sortedCount_ = starts[brickBins];
    const std::span<const std::uint64_t> rest = std::span<const std::uint64_t>(sorted, total).subspan(sortedCount_);
    const std::size_t above = starts[brickBins + 1] - sortedCount_;
    collectUpper(rest.first(above), kernel);
    leaveOut(rest.subspan(above), store);
}

/// Two stable counting sorts, by the lower and by the upper twelve bits of the brick.
template <LevelRule rule>
void BrickPartition::sortWide(const particles::ParticleStore& store, const CellKernel<rule>& kernel,
                              const VoxelRule& voxelRule) {
    constexpr std::uint64_t aboveBricks = 1u << 24, outside = aboveBricks + 1;
    const std::size_t total = store.size();
    std::uint64_t* const keys = wideKeys_.hold(total);
    std::uint64_t* const scratch = wideScratch_.hold(total);
    parallel::forEachBlock(total, leastChunk, [&](std::size_t first, std::size_t count) {
        const CellKernel<rule> cellOf = kernel;
        for (std::size_t i = first; i < first + count; ++i) {
            const ParticleCell cell = cellOf(i);
            const std::uint64_t inTree = cell.aboveBricks ? aboveBricks : cell.brickCode;
            const std::uint64_t brick = cell.outside ? outside : inTree;
            keys[i] = (brick << brickCodeBits | locationCode(cell.localCode, cell.rise)) << wideIndexBits | i;
        }
    });
    const int brickShift = wideIndexBits + brickCodeBits;
    scatterWide(keys, scratch, total, brickShift, wideDigit);
    scatterWide(scratch, keys, total, brickShift + 12, 2 * wideDigit + 1);

    std::uint64_t* const sorted = sorted_.hold(total);
    parallel::forEachBlock(total, leastChunk, [&, word = key_](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto particle = static_cast<std::uint32_t>(keys[i] & wideIndexMask);
            const std::uint32_t location = static_cast<std::uint32_t>(keys[i] >> wideIndexBits) & (brickCodes - 1);
            sorted[i] = word.make(voxelRule.priority(particle), location, particle);
        }
    });

    Brick* const bricks = bricks_.hold(total);
    brickCount_ = 0;
    std::uint64_t last = outside;
    std::uint32_t i = 0;
    for (; i < total && keys[i] >> brickShift < aboveBricks; ++i) {
        const std::uint64_t brick = keys[i] >> brickShift;
        if (brick != last) bricks[brickCount_++] = {brick << 3 * brickRise, i, 0};
        ++bricks[brickCount_ - 1].count;
        last = brick;
    }
    sortedCount_ = i;
    const std::span<const std::uint64_t> rest = std::span<const std::uint64_t>(sorted, total).subspan(sortedCount_);
    std::size_t above = 0;
    while (above < rest.size() && keys[sortedCount_ + above] >> brickShift == aboveBricks) ++above;
    collectUpper(rest.first(above), kernel);
    leaveOut(rest.subspan(above), store);
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

/// Particles above the bricks, as entries of the whole tree.
template <LevelRule rule>
void BrickPartition::collectUpper(std::span<const std::uint64_t> above, const CellKernel<rule>& kernel) {
    CellEntry* const upper = upper_.hold(above.size());
    upperCount_ = above.size();
    for (std::size_t k = 0; k < above.size(); ++k) {
        const std::uint32_t particle = key_.particle(above[k]);
        const ParticleCell cell = kernel(particle);
        const std::uint64_t code = static_cast<std::uint64_t>(cell.brickCode) << 3 * brickRise | cell.localCode;
        upper[k] = CellEntry(code, static_cast<int>(cell.rise), particle);
    }
}

/// Particles outside the world, which is where those end up whose position is not a number.
void BrickPartition::leaveOut(std::span<const std::uint64_t> outside, const particles::ParticleStore& store) {
    clipped_ = static_cast<std::int64_t>(outside.size());
    for (const std::uint64_t key : outside) checkPosition(store, key_.particle(key));
}

}  // namespace dustbench::octree
