// The search principle as in the paper. For each particle, the bits of the coordinates lead level by level from the
// root to the voxel, and missing nodes are created on the way. A separate traversal lists the voxels.
//
// Owns: the active particles and the voxels in order of discovery, booked on a ledger. Threads: one.
// Source: Carr2006, 3.4, 3.5 and Fig. 3.
#pragma once

#include "methods/contract/volume.h"
#include "methods/kit/octree/octree_builder.h"
#include "methods/kit/octree/particle_place.h"
#include "methods/kit/octree/voxel_rule.h"

namespace dustbench::octree_search {

class PaperBuilder final : public octree::OctreeBuilder {
 public:
    explicit PaperBuilder(MemoryLedger& ledger)
        : active_(ledger.account("octree particle lists")), found_(ledger.account("octree voxels found")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

    struct Voxel {
        octree::CellEntry entry;  ///< with the particle that represents it
        double massSquareMetres;
    };

 private:
    void insert(std::uint32_t particle, const octree::ParticlePlace& place, const octree::VoxelRule& rule,
                octree::Octree& tree);

    LedgerVector<std::uint32_t> active_;
    LedgerVector<Voxel> found_;
};

}  // namespace dustbench::octree_search
