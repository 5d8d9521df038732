// The modern layout for both methods: sorts the particles into bricks of 16³ cells once, reduces each brick to its
// voxels independently and in parallel, and assembles the bricks.
//
// Owns: the voxels found in each brick, booked on a ledger. Threads: parallel over bricks in the current oneTBB arena;
// the tree does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/brick_partition.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::octree {

/// Output of one brick's reduction: its voxels in pre-order.
struct BrickVoxels {
    CellEntry* voxels;  ///< capacity: as many as the brick has particles
    CellEntry* spare;   ///< working memory of the same size; null if not requested
    double* masses;     ///< one per voxel; null if not requested
    BrickNodes& nodes;  ///< output
};

/// Assembles the voxels of all bricks, and the voxels larger than a brick, into one tree.
class DUSTBENCH_API BrickAssembly {
 public:
    explicit BrickAssembly(MemoryLedger& ledger);

    void hold(const BrickPartition& partition, bool withMasses, bool withSpare);
    /// Output arrays for brick number `i` of the partition.
    [[nodiscard]] BrickVoxels room(const Brick& brick, std::size_t i) {
        return {found_.data() + brick.first, withSpare_ ? spare_.data() + brick.first : nullptr,
                withMasses_ ? masses_.data() + brick.first : nullptr, nodes_.data()[i]};
    }
    void assemble(BrickPartition& partition, const VoxelRule& rule, int depth, Octree& tree);

 private:
    struct Place {
        std::uint32_t firstVoxel = 0, firstBlock = 0;
    };

    std::size_t reduceUpper(std::span<CellEntry> upper, const VoxelRule& rule);
    void numberVoxels(std::span<const Brick> bricks, std::span<const CellEntry> upper);
    void writeBricks(std::span<const Brick> bricks, Octree& tree);
    void addTop(std::span<const Brick> bricks, std::span<const CellEntry> upper, Octree& tree);

    bool withMasses_ = false, withSpare_ = false;
    ReusedArray<CellEntry> found_, spare_;
    ReusedArray<double> masses_, upperMasses_;
    ReusedArray<BrickNodes> nodes_;
    ReusedArray<Place> places_;
    ReusedArray<std::uint32_t> upperPlaces_;
    std::uint32_t voxels_ = 0, blocks_ = 0;
};

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
