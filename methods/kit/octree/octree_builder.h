// Interface of the octree builders. All builders return the same voxels in the same order.
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
    /// Returns the number of particles outside the world, which belong to no voxel. Throws SimulationError if a
    /// position is NaN.
    virtual std::int64_t build(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings,
                               Octree& tree) = 0;
    /// Bytes of the structure with the voxels of `tree`, the last one built, without temporary memory of the build.
    [[nodiscard]] virtual std::size_t structureBytes(const Octree& tree) const { return tree.bytes(); }
};

}  // namespace dustbench::octree
