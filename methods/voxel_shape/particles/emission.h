// Births: every active voxel below its maximum density emits the missing particles at random positions inside it. They
// have the voxel's look and the shape's velocity.
//
// Neither births nor arrivals from other voxels (particle_kernel.h, `admit`) raise a voxel above its maximum density,
// except for arrivals if `Motion::fullVoxelsRefuse` is false.
//
// Owns: its lists, on a ledger. Threads: uses the current oneTBB arena; the births do not depend on the number of
// threads: serials follow the order of the voxels, and random numbers are derived from the serials.
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

    /// Appends the particles born in one step and adds them to the densities of their voxels.
    void emit(ShapeParticles& particles, VoxelGrid& grid, const Pose& pose, const Motion& motion, float stepSeconds);

 private:
    std::uint64_t seed_;
    std::uint64_t nextSerial_ = 0;
    std::uint32_t steps_ = 0;
    [[nodiscard]] std::size_t countBirths(const VoxelGrid& grid, float share);

    LedgerVector<std::uint32_t> births_;  ///< of each active voxel in this step
    LedgerVector<std::size_t> starts_;    ///< per block of active voxels: index of its first birth
};

}  // namespace dustbench::voxel_shape
