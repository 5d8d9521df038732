#include "methods/octree_search/grid_reducer.h"

#include <algorithm>
#include <bit>

namespace dustbench::octree_search {

using namespace octree;

void GridReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    const BrickKey word = partition.key();
    std::uint32_t count = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        const std::uint32_t place = word.place(key);
        const std::uint64_t holder = best_[place];
        touched_[count] = static_cast<std::uint16_t>(place);
        count += holder == 0 ? 1 : 0;
        std::uint64_t best = std::max(holder, key);
        if (word.samePriority(holder, key) && holder != 0)  // rare: what is not in the word decides
            best = rule_.wins(word.particle(key), word.particle(holder)) ? key : holder;
        best_[place] = best;
    });
    if (voxels.masses) {
        for (std::uint32_t i = 0; i < count; ++i) sums_[touched_[i]] = 0;
        partition.forEachParticle(
            brick, [&](std::uint64_t key) { sums_[word.place(key)] += rule_.massSquareMetres(word.particle(key)); });
    }

    voxels.nodes.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = touched_[i];
        taken_[place / 64] |= std::uint64_t{1} << place % 64;
        voxels.nodes.setVoxel(place);
    }
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < taken_.size(); ++i) {
        takenBefore_[i] = before;
        before += static_cast<std::uint32_t>(std::popcount(taken_[i]));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t place = touched_[i];
        const std::uint64_t lower = (std::uint64_t{1} << place % 64) - 1;
        const std::uint32_t rank =
            takenBefore_[place / 64] + static_cast<std::uint32_t>(std::popcount(taken_[place / 64] & lower));
        voxels.voxels[rank] = voxelAt(brick, place, word.particle(best_[place]));
        if (voxels.masses) voxels.masses[rank] = sums_[place];
        best_[place] = 0;
    }
    taken_.fill(0);
    voxels.nodes.complete();
}

}  // namespace dustbench::octree_search
