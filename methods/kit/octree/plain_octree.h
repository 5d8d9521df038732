// Reference implementation of the octree's voxels, one particle at a time; tests compare all builders with it.
//
// Units: metres. Frame: world. Threads: pure. Source: Carr2006, Fig. 3 (a puff's voxel is the cell that contains its
// centre, at a level set by its age). Departs: octree_settings.h defines the voxel of several particles.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "methods/contract/volume.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

struct PlainVoxel {
    std::uint32_t particle = 0;   ///< the particle that represents the voxel
    double massSquareMetres = 0;  ///< of all particles in the voxel
};

struct PlainOctree {
    /// Levels above the finest, and the cell's number along each axis at that level.
    using Cell = std::tuple<int, std::int64_t, std::int64_t, std::int64_t>;
    std::map<Cell, PlainVoxel> voxels;
    std::int64_t clipped = 0;  ///< particles outside the world
};

[[nodiscard]] PlainOctree plainOctree(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

}  // namespace dustbench::octree
