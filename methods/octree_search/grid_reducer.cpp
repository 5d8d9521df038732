#include "methods/octree_search/grid_reducer.h"

#include <algorithm>

namespace dustbench::octree_search {

using namespace octree;

void GridReducer::reduce(const BrickPartition& partition, const Brick& brick, const BrickVoxels& voxels) {
    std::uint32_t count = 0;
    partition.visitParticles(brick, rule_.values(), [&](std::uint32_t location, std::uint32_t particle) {
        const std::uint64_t holder = best_[location];
        const std::uint64_t key = static_cast<std::uint64_t>(rule_.priority(particle)) << 32 | ~particle;
        touched_[count] = static_cast<std::uint16_t>(location);
        count += holder == 0 ? 1 : 0;
        std::uint64_t best = std::max(holder, key);
        if (((holder ^ key) >> 32) == 0 && holder != 0)  // rare: equal, so that the serials decide
            best = rule_.firstBorn(particle, ~static_cast<std::uint32_t>(holder)) ? key : holder;
        best_[location] = best;
    });
    if (voxels.masses) {
        for (std::uint32_t i = 0; i < count; ++i) sums_[touched_[i]] = 0;
        partition.visitParticles(brick, rule_.values(), [&](std::uint32_t location, std::uint32_t particle) {
            sums_[location] += rule_.massSquareMetres(particle);
        });
        for (std::uint32_t i = 0; i < count; ++i) voxels.masses[i] = sums_[touched_[i]];
    }
    voxels.nodes.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t location = touched_[i];
        voxels.nodes.setVoxel(location);
        voxels.voxels[i] = {location, ~static_cast<std::uint32_t>(best_[location])};
        best_[location] = 0;
    }
    voxels.nodes.complete();
}

}  // namespace dustbench::octree_search
