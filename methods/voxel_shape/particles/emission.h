// Births: every active voxel below its maximum density makes up for what it lacks, at random places in it, with its own
// looks and the shape's motion as momentum.
//
// Neither births nor those that wander in from another voxel (particle_kernel.h, `admit`) lift a voxel above its
// maximum; the latter do where `Motion::fullVoxelsRefuse` is false.
//
// Owns: its lists, on a ledger. Threads: uses the current oneTBB arena; the births are the same at any number of
// threads: their serials follow the voxels' order, and their random numbers their serials.
// Source: JuckelBeckhaus2007, 4.3 and 5.
#pragma once

#include "methods/voxel_shape/particles/motion.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

class Emission {
 public:
    Emission(MemoryLedger& ledger, std::uint64_t seed);

    /// Appends the newborn of one step and counts them in their voxels.
    void emit(ShapeParticles& particles, VoxelGrid& grid, const Pose& pose, const Motion& motion, float stepSeconds);

 private:
    std::uint64_t seed_;
    std::uint64_t nextSerial_ = 0;
    std::uint32_t steps_ = 0;
    [[nodiscard]] std::size_t countBirths(const VoxelGrid& grid, float share);

    LedgerVector<std::uint32_t> births_;  ///< of each active voxel in this step
    LedgerVector<std::size_t> starts_;    ///< of each block of active voxels: the first of its newborn
};

}  // namespace dustbench::voxel_shape
