// Recursive construction as in the paper: node by node, the particles are compared with the centre of the node and
// copied to the lists of its eight cubes. Voxels are listed in the same pass.
//
// Owns: eight lists per level, booked on a ledger. Threads: one.
// Source: Carr2006, 3.3 and 3.5. Departs: all nodes of a level share their lists, since one node is open at a time.
#pragma once

#include <vector>

#include "methods/contract/volume.h"
#include "methods/kit/octree/octree_builder.h"

namespace dustbench::octree_recursive {

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

}  // namespace dustbench::octree_recursive
