// Recursive construction as the paper describes it: a node's particles are compared with the middle of the node and
// copied to the lists of its eight cubes, one node after the other; voxels are listed on the way.
//
// Owns: eight lists a level, booked on a ledger. Threads: one.
// Source: Carr2006, 3.3 and 3.5. Departs: lists are reused by all nodes of a level, of which one is open at a time.
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
