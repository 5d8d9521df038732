#include "methods/shared/octree/brick_partition.h"

#include <algorithm>

#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

/// As few chunks as keep the threads busy: each has counters of its own.
constexpr std::size_t wantedChunks = 16;
constexpr std::size_t leastChunk = 16'384;
/// Particles whose words are made at once, by the vector units, before they are counted.
constexpr std::size_t stripSize = 1024;
/// Up to this depth bricks are few enough to be bins.
constexpr int narrowDepth = 8;
constexpr std::uint32_t wideDigit = 4095;

/// A function of its own, so that the compiler sees that the keys lie apart from what they are made of.
template <LevelRule rule>
[[gnu::noinline]] void makeNarrowKeys(const CellKernel<rule>& kernel, std::size_t first, std::size_t count,
                                      std::uint32_t brickBins, std::uint32_t* __restrict keys) {
    const CellKernel<rule> cellOf = kernel;
    for (std::size_t i = 0; i < count; ++i) {
        const ParticleCell cell = cellOf(first + i);
        const std::uint32_t inTree = (cell.brickCode & ~cell.aboveBricks) | (brickBins & cell.aboveBricks);
        const std::uint32_t bin = (inTree & ~cell.outside) | ((brickBins + 1) & cell.outside);
        keys[i] = bin << brickCodeBits | locationCode(cell.localCode, cell.rise);
    }
}

}  // namespace

BrickPartition::BrickPartition(MemoryLedger& ledger)
    : narrowKeys_(ledger.account("octree bricks")),
      narrowSorted_(ledger.account("octree bricks")),
      wideKeys_(ledger.account("octree bricks")),
      wideSorted_(ledger.account("octree bricks")),
      counts_(ledger.account("octree bricks")),
      binStarts_(ledger.account("octree bricks")),
      bricks_(ledger.account("octree bricks")),
      upper_(ledger.account("octree bricks")) {}

void BrickPartition::sort(const particles::ParticleStore& store, const Lattice& lattice,
                          const OctreeSettings& settings) {
    checkCount(store);
    wide_ = lattice.depth > narrowDepth;
    const auto sortBy = [&](const auto& kernel) {
        if (wide_)
            sortWide(store, kernel);
        else
            sortNarrow(store, kernel, lattice.depth);
    };
    if (settings.levelRule == LevelRule::age)
        sortBy(CellKernel<LevelRule::age>(store, lattice, settings));
    else
        sortBy(CellKernel<LevelRule::radius>(store, lattice, settings));
    if (clipped_ > 0) checkPositions(store);
}

void BrickPartition::setChunks(std::size_t count, std::uint32_t bins) {
    chunkSize_ = std::clamp((count + wantedChunks - 1) / wantedChunks, leastChunk, std::size_t{indexMask} + 1);
    chunks_ = (count + chunkSize_ - 1) / chunkSize_;
    bins_ = bins;
    counts_.hold(chunks_ * bins_);
    binStarts_.hold(bins_ + 1);
}

/// From how many to where the first one goes.
void BrickPartition::startBins() {
    std::uint32_t* const counts = counts_.data();
    std::uint32_t* const starts = binStarts_.data();
    std::uint32_t sum = 0;
    for (std::uint32_t bin = 0; bin < bins_; ++bin) {
        starts[bin] = sum;
        for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
            std::uint32_t& cell = counts[chunk * bins_ + bin];
            const std::uint32_t here = cell;
            cell = sum;
            sum += here;
        }
    }
    starts[bins_] = sum;
}

/// One stable counting sort by brick. Two bins more: voxels above the bricks, and particles outside the world.
template <LevelRule rule>
void BrickPartition::sortNarrow(const particles::ParticleStore& store, const CellKernel<rule>& kernel, int depth) {
    const std::size_t total = store.size();
    const std::uint32_t brickBins = 1u << 3 * (depth - brickRise);
    setChunks(total, brickBins + 2);
    std::uint32_t* const keys = narrowKeys_.hold(total);
    std::uint32_t* const sorted = narrowSorted_.hold(total + ahead);
    std::uint32_t* const counts = counts_.data();

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
            sorted[next[key >> brickCodeBits]++] = key << indexBits | static_cast<std::uint32_t>(i);
        }
    });

    const std::uint32_t* const starts = binStarts_.data();
    Brick* const bricks = bricks_.hold(brickBins);
    brickCount_ = 0;
    for (std::uint32_t bin = 0; bin < brickBins; ++bin)
        if (starts[bin + 1] > starts[bin])
            bricks[brickCount_++] = {std::uint64_t{bin} << 3 * brickRise, starts[bin], starts[bin + 1] - starts[bin]};
    sortedCount_ = starts[brickBins];
    clipped_ = static_cast<std::int64_t>(starts[brickBins + 2] - starts[brickBins + 1]);
    collectUpper(store, starts[brickBins], starts[brickBins + 1] - starts[brickBins], kernel);
}

/// Two stable counting sorts, by the lower and by the upper twelve bits of the brick.
template <LevelRule rule>
void BrickPartition::sortWide(const particles::ParticleStore& store, const CellKernel<rule>& kernel) {
    constexpr std::uint64_t aboveBricks = 1u << 24, outside = aboveBricks + 1;
    const std::size_t total = store.size();
    std::uint64_t* const keys = wideKeys_.hold(total);
    std::uint64_t* const sorted = wideSorted_.hold(total);
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
    scatterWide(keys, sorted, total, brickShift, wideDigit);
    scatterWide(sorted, keys, total, brickShift + 12, 2 * wideDigit + 1);
    std::copy_n(keys, total, sorted);

    Brick* const bricks = bricks_.hold(total);
    brickCount_ = 0;
    std::uint64_t last = outside;
    std::uint32_t i = 0;
    for (; i < total && sorted[i] >> brickShift < aboveBricks; ++i) {
        const std::uint64_t brick = sorted[i] >> brickShift;
        if (brick != last) bricks[brickCount_++] = {brick << 3 * brickRise, i, 0};
        ++bricks[brickCount_ - 1].count;
        last = brick;
    }
    sortedCount_ = i;
    const std::size_t firstUpper = i;
    while (i < total && sorted[i] >> brickShift == aboveBricks) ++i;
    clipped_ = static_cast<std::int64_t>(total - i);
    collectUpper(store, firstUpper, i - firstUpper, kernel);
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

/// The sorted particles from `first` on, of the bin above the bricks, as entries of the whole tree.
template <LevelRule rule>
void BrickPartition::collectUpper(const particles::ParticleStore& store, std::size_t first, std::size_t count,
                                  const CellKernel<rule>& kernel) {
    CellEntry* const upper = upper_.hold(count);
    upperCount_ = count;
    if (count == 0) return;
    const auto put = [&](std::size_t k, std::uint32_t particle) {
        const ParticleCell cell = kernel(particle);
        const std::uint64_t code = static_cast<std::uint64_t>(cell.brickCode) << 3 * brickRise | cell.localCode;
        upper[k] = CellEntry(code, static_cast<int>(cell.rise), particle);
    };
    if (wide_) {
        for (std::size_t k = 0; k < count; ++k)
            put(k, static_cast<std::uint32_t>(wideSorted_.data()[first + k] & wideIndexMask));
        return;
    }
    const Brick bin{static_cast<std::uint64_t>(bins_ - 2) << 3 * brickRise, static_cast<std::uint32_t>(first),
                    static_cast<std::uint32_t>(count)};
    std::size_t k = 0;
    visitParticles(bin, store.x.data(), [&](std::uint32_t, std::uint32_t particle) { put(k++, particle); });
}

}  // namespace dustbench::octree
