// Dust whose voxels have an opacity by age alone, independent of their size.
//
// A particle's opacity is α by age. Its radius is that of a puff whose mass, spread over its voxel, has the optical
// depth τ = −ln(1 − α) along an axis: τ·2π(r/2)² = τ·edge². All other code works as for any dust.
//
// Units: metres. Owns: two columns, booked on a ledger. Threads: one.
// Source: Carr2006, 3.2.
#pragma once

#include "methods/contract/volume.h"
#include "methods/kit/draw/age_opacity.h"
#include "methods/kit/octree/lattice.h"
#include "methods/kit/octree/octree_settings.h"

namespace dustbench::octree {

class VoxelOpacity {
 public:
    VoxelOpacity(MemoryLedger& ledger, double youngOpacity)
        : opacities_(ledger.account("opacities by age"), youngOpacity), radii_(ledger.account("opacities by age")) {}

    /// The same particles with new opacities and radii, in the same voxels; valid until the next call.
    Puffs of(const Puffs& dust, const Lattice& lattice, const OctreeSettings& settings);

 private:
    draw::AgeOpacity opacities_;
    LedgerVector<float> radii_;
};

}  // namespace dustbench::octree
