// Keeps the voxels of the last frame and fades to those of this one: a voxel's mass follows what the octree says with a
// time constant, so that none pops in or out.
//
//     m ← m + (1 − exp(−Δt/T))·(m_octree − m)
//
// Units: seconds, m². Owns: the faded voxels, on a ledger. Threads: one.
// Source: Carr2006, 5 (left to the future: "interpolating or cross-fading between frames"). Departs: the formula is
// ours.
#pragma once

#include "methods/kit/octree/voxel_cloud.h"

namespace dustbench::octree {

class CrossFade {
 public:
    CrossFade(MemoryLedger& ledger, double timeConstantSeconds);

    /// Goes on by one frame towards `target`, whose places rise, and gives what is to be drawn, in the same order. The
    /// first call gives the target itself. Voxels that a moved world no longer holds are dropped.
    const VoxelCloud& follow(const VoxelCloud& target, double stepSeconds);

 private:
    void moveTo(const Lattice& lattice);
    void append(const VoxelCloud& from, std::size_t i, float mass);

    double timeConstantSeconds_;
    bool first_ = true;
    VoxelCloud shown_, next_;
    LedgerVector<std::uint32_t> order_;
};

}  // namespace dustbench::octree
