// Cross-fades voxels between frames: a voxel's mass follows that of the octree with a time constant, so that no voxel
// pops in or out.
//
//     m ← m + (1 − exp(−Δt/T))·(m_octree − m)
//
// Units: seconds, m². Owns: the faded voxels, booked on a ledger. Threads: one.
// Source: Carr2006, 5 (future work: "interpolating or cross-fading between frames"). Departs: the formula is ours.
#pragma once

#include "methods/kit/octree/voxel_cloud.h"

namespace dustbench::octree {

class CrossFade {
 public:
    CrossFade(MemoryLedger& ledger, double timeConstantSeconds);

    /// Advances by one frame towards `target`, whose places must ascend. Returns the voxels to draw, in the same order.
    /// The first call returns a copy of the target. If the world has moved, voxels outside of it are dropped.
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
