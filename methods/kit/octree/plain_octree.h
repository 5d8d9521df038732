// The voxels of a set of particles, one particle after the other: what all builders of the octree are held against.
//
// Units: metres. Frame: world. Threads: pure. Source: Carr2006, Fig. 3 (a puff's voxel is the cell that its centre lies
// in, on a level that its age decides). Departs: octree_settings.h says what a voxel of several particles takes.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>

#include "methods/contract/volume.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

struct PlainVoxel {
    std::uint32_t particle = 0;   ///< that it stands for
    double massSquareMetres = 0;  ///< of all particles in it
};

struct PlainOctree {
    /// Levels above the finest, and the cell's number along each axis at that level.
    using Cell = std::tuple<int, std::int64_t, std::int64_t, std::int64_t>;
    std::map<Cell, PlainVoxel> voxels;
    std::int64_t clipped = 0;  ///< particles outside the world
};

[[nodiscard]] PlainOctree plainOctree(const Puffs& store, const Lattice& lattice, const OctreeSettings& settings);

}  // namespace dustbench::octree
