#include "methods/kit/octree/particle_cells.h"

#include <algorithm>
#include <array>

#include "methods/contract/volume.h"
#include "methods/kit/octree/cell_kernel.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {
namespace {

constexpr std::size_t blockSize = 16'384;
constexpr std::size_t stripSize = 256;  ///< particles whose words the vector units compute at once

}  // namespace

ParticleCells::ParticleCells(MemoryLedger& ledger)
    : entries_(ledger.account("octree particle cells")), blockSizes_(ledger.account("octree particle cells")) {}

/// Each block compacts the particles inside the world to its own front.
template <LevelRule rule>
void ParticleCells::fill(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings) {
    CellEntry* const entries = entries_.data();
    std::uint32_t* const blockSizes = blockSizes_.data();
    parallel::forEachBlock(store.size(), blockSize, [&](std::size_t first, std::size_t length) {
        const CellKernel<rule> kernel(store, lattice, settings);
        std::array<std::uint64_t, stripSize> words;
        std::array<std::uint32_t, stripSize> inside;
        CellEntry* out = entries + first;
        for (std::size_t strip = first; strip < first + length; strip += stripSize) {
            const std::size_t here = std::min(stripSize, first + length - strip);
            for (std::size_t i = 0; i < here; ++i) {
                const ParticleCell cell = kernel(strip + i);
                const std::uint32_t high = cell.brickCode << 8 | cell.localCode >> 4;
                const std::uint32_t low =
                    cell.localCode << 28 | cell.rise << 24 | static_cast<std::uint32_t>(strip + i);
                words[i] = static_cast<std::uint64_t>(high) << 32 | low;
                inside[i] = cell.outside + 1;
            }
            for (std::size_t i = 0; i < here; ++i) {
                *out = CellEntry(words[i]);
                out += inside[i];
            }
        }
        blockSizes[first / blockSize] = static_cast<std::uint32_t>(out - (entries + first));
    });
}

void ParticleCells::find(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings) {
    checkCount(store);
    const std::size_t count = store.size();
    const std::size_t blocks = (count + blockSize - 1) / blockSize;
    CellEntry* const entries = entries_.hold(count);
    const std::uint32_t* const blockSizes = blockSizes_.hold(blocks);
    if (settings.levelRule == LevelRule::age)
        fill<LevelRule::age>(store, lattice, settings);
    else
        fill<LevelRule::radius>(store, lattice, settings);

    std::size_t kept = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
        const CellEntry* const from = entries + block * blockSize;
        if (kept != block * blockSize) std::copy(from, from + blockSizes[block], entries + kept);
        kept += blockSizes[block];
    }
    count_ = kept;
    clipped_ = static_cast<std::int64_t>(count - kept);
    if (clipped_ > 0) checkPositions(store);
}

std::int64_t listActive(const Puffs& store, const ParticlePlace& place, LedgerVector<std::uint32_t>& active) {
    checkCount(store);
    active.clear();
    for (std::uint32_t i = 0; i < store.size(); ++i)
        if (place.isInside(i)) active.push_back(i);
    const auto clipped = static_cast<std::int64_t>(store.size() - active.size());
    if (clipped > 0) checkPositions(store);
    return clipped;
}

}  // namespace dustbench::octree
