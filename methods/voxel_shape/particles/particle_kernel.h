// One step of a run of particles: look up the voxel, apply its force, move, approach its look.
//
// Units: m, s. Frame: world. Threads: pure except for the voxels' densities, which are decremented atomically. Several
// threads may update disjoint runs of particles; the sums do not depend on the number of threads.
// Source: JuckelBeckhaus2007, 4.2, 4.3 and 5.1. Departs: the paper gives no formulas for the influences in Motion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Influences on the motion of all particles of a shape, in addition to the voxels' forces, and the rule for admission
/// to voxels.
struct Motion {
    glm::vec3 gravity{0};          ///< acceleration
    glm::vec3 wind{0};             ///< velocity of the air
    float airDragPerSecond = 0;    ///< rate at which a particle's velocity approaches the air's; 0: no air
    float responsePerSecond = 10;  ///< rate at which spirals and helices pull a particle's velocity to their own
    float birthSpeed = 0;          ///< maximum speed of newborns relative to the shape, in a random direction
    float fillSeconds = 0;         ///< time in which a voxel replaces missing particles; 0: at once
    /// Full voxels admit no particle. False, as in the paper: the maximum density limits births only.
    bool fullVoxelsRefuse = true;
};

/// Constants of a step. `pose` is the pose at the beginning of the step, at which the particles are then: look-ups,
/// directions of forces and the shape's own velocity all refer to that time.
struct KernelStep {
    KernelStep(const VoxelGrid& grid, const Pose& pose, const Motion& motion, float stepSeconds);

    glm::mat3 toVoxels;  ///< world → voxels from the minimum corner: toVoxels·p + offset
    glm::vec3 offset;
    glm::ivec3 counts;
    float voxelMetres;  ///< edge of a voxel in the world
    Pose pose;
    float seconds;
    float response;  ///< share of the difference to a rotational force's velocity that is removed
    float airKeeps;  ///< share of the velocity relative to the air that remains
    glm::vec3 wind;
    glm::vec3 gravityStep;  ///< change of velocity by gravity
};

/// Updates particles first .. first + count. Sets `dead[i]` to 1 if the particle dies, otherwise to 0. Sets
/// `arriving[i]` to 1 if the particle has reached a voxel that may admit it, otherwise to 0; it stays outside that
/// voxel until `admit`.
void updateParticles(ShapeParticles& particles, std::size_t first, std::size_t count, VoxelGrid& grid,
                     const KernelStep& step, std::uint8_t* dead, std::uint8_t* arriving);

/// Call after all particles are updated. Clears `arriving` for particles first .. first + count whose voxel is full, as
/// most voxels are. The result is final: no particle leaves a voxel later in the same step.
void dropWhereFull(const ShapeParticles& particles, std::size_t first, std::size_t count, std::span<const Voxel> voxels,
                   std::uint8_t* arriving);

/// Admits each arriving particle to the voxel at its position if that has room, in the order of `arrivals`. The others
/// stay outside, fade by that voxel's fading look, and are considered again in the next step. `fullRefuse` false: all
/// are admitted. `targets`: scratch memory as long as `arrivals`.
void admit(ShapeParticles& particles, std::span<const std::uint32_t> arrivals, std::span<std::uint32_t> targets,
           std::span<Voxel> voxels, bool fullRefuse);

}  // namespace dustbench::voxel_shape
