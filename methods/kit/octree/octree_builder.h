// Interface of the ways to build the octree from particles. All builders return the same voxels in the same order.
#pragma once

#include <cstdint>

#include "methods/contract/volume.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

class DUSTBENCH_API OctreeBuilder {
 public:
    virtual ~OctreeBuilder();
    /// Returns the number of particles outside the world, which are in no voxel. Throws SimulationError if a position
    /// is NaN.
    virtual std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                               Octree& tree) = 0;
    /// Bytes of the structure that holds the voxels of `tree`, the last one built; without what building it needed.
    [[nodiscard]] virtual std::size_t structureBytes(const Octree& tree) const { return tree.bytes(); }
};

}  // namespace dustbench::octree
