// Recursive construction: splits a node's list of particles into the lists of its eight children and creates voxels at
// the right level; the same walk also lists the voxels.
//
// Owns: the lists, booked on a ledger, as one stack: a node's lists lie above its parent's. Threads: one, as in the
// paper.
// Source: Carr2006, 3.3 and 3.5.
#pragma once

#include "methods/contract/volume.h"
#include "methods/kit/octree/octree_builder.h"
#include "methods/kit/octree/particle_cells.h"

namespace dustbench::octree_recursive {

class ListBuilder final : public octree::OctreeBuilder {
 public:
    explicit ListBuilder(MemoryLedger& ledger) : cells_(ledger), lists_(ledger.account("octree particle lists")) {}

    std::int64_t build(const Puffs& store, const octree::Lattice& lattice, const octree::OctreeSettings& settings,
                       octree::Octree& tree) override;

 private:
    octree::ParticleCells cells_;
    octree::ReusedArray<octree::CellEntry> lists_;
};

}  // namespace dustbench::octree_recursive
