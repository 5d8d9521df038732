// A voxel shape in motion: its grid, its particles, their births and their update.
//
// Units: m, s. Frame: world. Owns: voxels and particles, on a ledger. Threads: one caller at a time; uses the current
// oneTBB arena; the state does not depend on the number of threads.
// Source: JuckelBeckhaus2007, 4.3 (the update cycle) and 5 (births).
#pragma once

#include "methods/kit/particles/noted_particles.h"
#include "methods/voxel_shape/particles/particle_kernel.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Births: every active voxel below its maximum density emits the missing particles at random positions inside it. They
/// have the voxel's look and the shape's velocity. Neither births nor arrivals from other voxels (particle_kernel.h,
/// `admit`) raise a voxel above its maximum density, except for arrivals if `Motion::fullVoxelsRefuse` is false.
/// Serials follow the order of the voxels, and random numbers are derived from the serials.
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

/// Numbers of a shape's particles.
struct ShapeCount {
    std::size_t inside = 0;  ///< held by voxels
    std::size_t fading = 0;  ///< outside all voxels, or waiting at a full one
    std::size_t room = 0;    ///< capacity of the voxels that are on
};

class ShapeSystem {
 public:
    ShapeSystem(MemoryLedger& ledger, const MarkedVoxels& marked, const Voxel& pattern, std::uint64_t seed);

    ShapeSystem(MemoryLedger& ledger, VoxelGrid grid, std::uint64_t seed);

    /// One step: `live`, then `replace`. Between the two, the caller may move particles out of solids and switch voxels
    /// on or off for `pose`.
    void step(const Pose& pose, const Motion& motion, float stepSeconds);
    /// Updates every particle: looks up its voxel, moves it, changes its look, and lets it enter a new voxel that has
    /// room. Records the particles that die. Particles and lattice are those left by the last `replace`.
    void live(const Motion& motion, float stepSeconds);
    /// Removes the dead particles recorded by `live`, then emits new ones. `pose`: the pose at the time to which `live`
    /// moved them.
    void replace(const Pose& pose, const Motion& motion, float stepSeconds);

    [[nodiscard]] const ShapeParticles& particles() const { return particles_; }
    [[nodiscard]] ShapeParticles& particles() { return particles_; }
    [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
    [[nodiscard]] VoxelGrid& grid() { return grid_; }
    /// The pose of the grid at the time of the particles' positions.
    [[nodiscard]] const Pose& pose() const { return pose_; }
    [[nodiscard]] ShapeCount count() const;
    /// Hash of particles and voxels.
    [[nodiscard]] std::uint64_t stateHash() const;

 private:
    void bury(std::span<const std::uint32_t> holes);

    VoxelGrid grid_;
    Pose pose_;  ///< of the grid, at the particles' time
    ShapeParticles particles_;
    particles::NotedParticles deaths_;
    LedgerVector<std::uint8_t> arriving_;  ///< 1: at a voxel that may admit it
    particles::NotedParticles arrivals_;   ///< the particles whose voxel had room after all had moved
    LedgerVector<std::uint32_t> targets_;  ///< the voxel of each of them
    Emission emission_;
};

}  // namespace dustbench::voxel_shape
