// The modern layout for both methods: sorts the particles into bricks of 16³ cells once, reduces each brick to its
// voxels independently and in parallel, and assembles the bricks.
//
// Threads: uses the current oneTBB arena; the tree does not depend on the number of threads.
#pragma once

#include <algorithm>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_assembly.h"
#include "methods/kit/octree/brick_partition.h"
#include "methods/kit/octree/octree_builder.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {

/// `Reducer(rule)` is constructed once for several bricks; `reduce(partition, brick, voxels)` writes the brick's
/// voxels. `Reducer::needsSpare` requests working memory.
template <typename Reducer>
class BrickBuilder final : public OctreeBuilder {
 public:
    explicit BrickBuilder(MemoryLedger& ledger) : partition_(ledger), assembly_(ledger) {}

    std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                       Octree& tree) override {
        const VoxelRule rule(store, settings.policy);
        partition_.sort(store, lattice, settings, rule);
        assembly_.hold(partition_, rule.accumulates(), Reducer::needsSpare);
        const std::span<const Brick> bricks = partition_.bricks();
        const std::size_t atOnce = std::clamp<std::size_t>(bricks.size() / 64, 1, 64);
        parallel::forEachBlock(bricks.size(), atOnce, [&](std::size_t first, std::size_t count) {
            Reducer reducer(rule);
            for (std::size_t i = first; i < first + count; ++i)
                reducer.reduce(partition_, bricks[i], assembly_.room(bricks[i], i));
        });
        assembly_.assemble(partition_, rule, settings.depth, tree);
        return partition_.clipped();
    }

 private:
    BrickPartition partition_;
    BrickAssembly assembly_;
};

}  // namespace dustbench::octree
