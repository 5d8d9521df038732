// One way to build the octree from particles. All builders give the same voxels, in the same order.
#pragma once

#include <cstdint>

#include "methods/shared/octree/lattice.h"
#include "methods/shared/octree/octree.h"
#include "methods/shared/octree/octree_settings.h"
#include "methods/shared/particles/particle_store.h"

namespace dustbench::octree {

class OctreeBuilder {
 public:
    virtual ~OctreeBuilder() = default;
    /// Gives how many particles lie outside the world and are in no voxel. Throws SimulationError where a position
    /// is not a number.
    virtual std::int64_t build(const particles::ParticleStore& store, const Lattice& lattice,
                               const OctreeSettings& settings, Octree& tree) = 0;
};

}  // namespace dustbench::octree
