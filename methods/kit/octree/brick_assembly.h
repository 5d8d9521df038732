// Assembles the voxels of all bricks, and the voxels larger than a brick, into one tree.
//
// Owns: the voxels found in each brick, booked on a ledger. Threads: parallel over bricks; the tree does not depend on
// the number of threads.
#pragma once

#include <cstdint>
#include <span>

#include "methods/kit/octree/brick_nodes.h"
#include "methods/kit/octree/brick_partition.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::octree {

/// Output of one brick's reduction: its voxels in pre-order.
struct BrickVoxels {
    CellEntry* voxels;  ///< capacity: as many as the brick has particles
    CellEntry* spare;   ///< working memory of the same size; null if not requested
    double* masses;     ///< one per voxel; null if not requested
    BrickNodes& nodes;  ///< output
};

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

}  // namespace dustbench::octree
