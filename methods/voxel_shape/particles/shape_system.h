// A voxel shape in motion: its grid, its particles, and a step of both.
//
// Units: m, s. Frame: world. Owns: voxels and particles, on a ledger. Threads: one caller at a time; uses the current
// oneTBB arena, and the state is the same at any number of threads.
// Source: JuckelBeckhaus2007, 4.3 (the update cycle).
#pragma once

#include "methods/kit/particles/noted_particles.h"
#include "methods/voxel_shape/particles/emission.h"
#include "methods/voxel_shape/particles/particle_kernel.h"

namespace dustbench::voxel_shape {

/// Of a shape's particles.
struct ShapeCount {
    std::size_t inside = 0;  ///< whom voxels hold
    std::size_t fading = 0;  ///< who is outside of them, or in a full one
    std::size_t room = 0;    ///< whom the voxels that are on would hold
};

class ShapeSystem {
 public:
    ShapeSystem(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern, std::uint64_t seed);

    ShapeSystem(MemoryLedger& ledger, VoxelGrid grid, std::uint64_t seed);

    /// One step: `live`, then `replace`. Between the two, particles may be moved out of solids, and voxels switched to
    /// what they are at `pose`.
    void step(const Pose& pose, const Motion& motion, float stepSeconds);
    /// Every particle looks up its voxel, moves, changes its looks, and enters the voxel if it is another one and has
    /// room; who has faded is noted. Particles and lattice are looked at where the last `replace` left both.
    void live(const Motion& motion, float stepSeconds);
    /// Buries whom `live` has noted, and gives birth. `pose`: of the moment to which `live` has moved the particles.
    void replace(const Pose& pose, const Motion& motion, float stepSeconds);

    [[nodiscard]] const ShapeParticles& particles() const { return particles_; }
    [[nodiscard]] ShapeParticles& particles() { return particles_; }
    [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
    [[nodiscard]] VoxelGrid& grid() { return grid_; }
    /// Of the grid, at the moment at which the particles are where they are.
    [[nodiscard]] const Pose& pose() const { return pose_; }
    [[nodiscard]] ShapeCount count() const;
    /// Of particles and voxels.
    [[nodiscard]] std::uint64_t stateHash() const;

 private:
    void bury(std::span<const std::uint32_t> holes);

    VoxelGrid grid_;
    Pose pose_;  ///< of the grid at the particles' moment
    ShapeParticles particles_;
    particles::NotedParticles deaths_;
    LedgerVector<std::uint8_t> arriving_;  ///< 1: stands in a voxel that may let it in
    particles::NotedParticles arrivals_;   ///< for which there was room when all had moved
    LedgerVector<std::uint32_t> targets_;  ///< which, for each of them
    Emission emission_;
};

}  // namespace dustbench::voxel_shape
