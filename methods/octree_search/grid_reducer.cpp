#include "methods/octree_search/grid_reducer.h"

#include <algorithm>

#include "methods/kit/octree/bits.h"

namespace dustbench::octree_search {

using namespace octree;

void GridReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    const BrickKey word = partition.key();
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        const std::uint32_t place = word.place(key);
        const std::uint64_t holder = best_[place];
        std::uint64_t best = std::max(holder, key);
        if (word.samePriority(holder, key) && holder != 0)  // rare: the word does not contain enough bits to decide
            best = rule_.wins(word.particle(key), word.particle(holder)) ? key : holder;
        best_[place] = best;
        isTaken_[place] = 1;
    });

    PlaceBits taken;
    for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = whichAreSet(&isTaken_[64 * i]);
    isTaken_.fill(0);
    voxels.nodes.set(taken);
    const std::uint32_t count = numbersOfBits(taken, taken_.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = taken_[i];
        voxels.voxels[i] = voxelAt(brick, place, word.particle(best_[place]));
        best_[place] = 0;
    }

    if (voxels.masses) {
        for (std::uint32_t i = 0; i < count; ++i) sums_[taken_[i]] = 0;
        partition.forEachParticle(
            brick, [&](std::uint64_t key) { sums_[word.place(key)] += rule_.massSquareMetres(word.particle(key)); });
        for (std::uint32_t i = 0; i < count; ++i) voxels.masses[i] = sums_[taken_[i]];
    }
}

}  // namespace dustbench::octree_search
