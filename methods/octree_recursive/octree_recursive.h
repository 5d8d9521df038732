// Octree construction by recursion, in three variants: as in the paper, with cells computed in advance, and for bricks
// by sorting.
//
// Owns: the lists, booked on a ledger. Threads: one, as in the paper; a reducer: one at a time.
// Source: Carr2006, 3.3 and 3.5.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/kit/octree/brick_builder.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/particle_cells.h"

namespace dustbench::octree_recursive {

/// As in the paper: node by node, the particles are compared with the centre of the node and copied to the lists of its
/// eight cubes. Voxels are listed in the same pass. Departs: all nodes of a level share their lists, since one node is
/// open at a time.
class PaperBuilder final : public octree::OctreeBuilder {
 public:
    explicit PaperBuilder(MemoryLedger& ledger);

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

    using List = LedgerVector<std::uint32_t>;  ///< particles

 private:
    List active_;
    std::vector<List> lists_;  ///< 8·level + cube; those of level 0 are not used
};

/// Splits a node's list of particles into the lists of its eight children and creates voxels at the right level; the
/// same walk also lists the voxels. The lists are one stack: a node's lists lie above its parent's.
class ListBuilder final : public octree::OctreeBuilder {
 public:
    explicit ListBuilder(MemoryLedger& ledger) : cells_(ledger), lists_(ledger.account("octree particle lists")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

 private:
    octree::ParticleCells cells_;
    octree::ReusedArray<octree::CellEntry> lists_;
};

/// Reduces a brick's particles to voxels by sorting their Morton codes: equivalent to splitting lists level by level,
/// with all levels done at once.
class SortingReducer {
 public:
    static constexpr bool needsSpare = true;

    explicit SortingReducer(const octree::VoxelRule& rule) : rule_(rule) {}

    /// Called by BrickBuilder.
    void reduce(const octree::BrickPartition& partition, const octree::Brick& brick, const octree::BrickVoxels& voxels);

 private:
    octree::VoxelRule rule_;
};

}  // namespace dustbench::octree_recursive
