// The search principle: derives each particle's path from its coordinates, follows it from the root and adds missing
// nodes; a separate traversal lists the voxels.
//
// Owns: the voxels in order of discovery, booked on a ledger. Threads: one, as in the paper.
// Source: Carr2006, 3.4 and 3.5.
#pragma once

#include "methods/contract/volume.h"
#include "methods/kit/octree/octree_builder.h"
#include "methods/kit/octree/particle_cells.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::octree_search {

class InsertionBuilder final : public octree::OctreeBuilder {
 public:
    explicit InsertionBuilder(MemoryLedger& ledger)
        : cells_(ledger),
          found_(ledger.account("octree voxels found")),
          foundMasses_(ledger.account("octree voxels found")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

 private:
    std::size_t insertAll(const octree::VoxelRule& rule, octree::Octree& tree);
    void list(std::size_t count, bool withMasses, octree::Octree& tree) const;

    octree::ParticleCells cells_;
    octree::ReusedArray<octree::CellEntry> found_;
    octree::ReusedArray<double> foundMasses_;
};

}  // namespace dustbench::octree_search
