#include "methods/octree_search/grid_reducer.h"

#include <algorithm>

namespace dustbench::octree_search {

using namespace octree;

void GridReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    const BrickKey word = partition.key();
    std::uint32_t count = 0;
    partition.forEachParticle(brick, [&](std::uint64_t key) {
        const std::uint32_t location = word.location(key);
        const std::uint64_t holder = best_[location];
        touched_[count] = static_cast<std::uint16_t>(location);
        count += holder == 0 ? 1 : 0;
        std::uint64_t best = std::max(holder, key);
        if (word.samePriority(holder, key) && holder != 0)  // rare: what is not in the word decides
            best = rule_.wins(word.particle(key), word.particle(holder)) ? key : holder;
        best_[location] = best;
    });
    if (voxels.masses) {
        for (std::uint32_t i = 0; i < count; ++i) sums_[touched_[i]] = 0;
        partition.forEachParticle(
            brick, [&](std::uint64_t key) { sums_[word.location(key)] += rule_.massSquareMetres(word.particle(key)); });
        for (std::uint32_t i = 0; i < count; ++i) voxels.masses[i] = sums_[touched_[i]];
    }
    voxels.nodes.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t location = touched_[i];
        voxels.nodes.setVoxel(location);
        voxels.voxels[i] = {location, word.particle(best_[location])};
        best_[location] = 0;
    }
    voxels.nodes.complete();
}

}  // namespace dustbench::octree_search
