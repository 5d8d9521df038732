// One step of a run of particles: look up the voxel, take its force, move, come nearer to how it says they look.
//
// Units: m, s. Frame: world. Threads: pure but for the voxels' densities, which are counted down atomically: several
// threads may work on disjoint runs of particles, and the sums do not depend on how many there are.
// Source: JuckelBeckhaus2007, 4.2, 4.3 and 5.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "methods/voxel_shape/particles/motion.h"
#include "methods/voxel_shape/particles/pose.h"
#include "methods/voxel_shape/particles/shape_particles.h"
#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// All that is the same for every particle of a step. `pose` is that of the step's beginning, when the particles are
/// where the step finds them: look-ups, forces' directions and the shape's own velocity are all of that moment.
struct KernelStep {
    KernelStep(const VoxelGrid& grid, const Pose& pose, const Motion& motion, float stepSeconds);

    glm::mat3 toVoxels;  ///< world → voxels from the minimum corner: toVoxels·p + offset
    glm::vec3 offset;
    glm::ivec3 counts;
    float voxelMetres;  ///< edge of a voxel in the world
    Pose pose;
    float seconds;
    float response;  ///< share of the way to a rotational force's velocity
    float airKeeps;  ///< share of the velocity relative to the air that is left
    glm::vec3 wind;
    glm::vec3 gravityStep;  ///< velocity that gravity adds
};

/// Works on particles first .. first + count. `dead[i]` becomes 1 where one dies, else 0;
/// `arriving[i]` where one has come to a voxel that may let it in (`admit`), else 0: until then it is outside of it.
void updateParticles(ShapeParticles& particles, std::size_t first, std::size_t count, VoxelGrid& grid,
                     const KernelStep& step, std::uint8_t* dead, std::uint8_t* arriving);

/// Once all particles have been updated: sets to 0 what is 1 in `arriving` for particles first .. first + count where
/// the voxel is full, as most are. It will stay so: nobody leaves any more in this step.
void dropWhereFull(const ShapeParticles& particles, std::size_t first, std::size_t count, std::span<const Voxel> voxels,
                   std::uint8_t* arriving);

/// Lets those into the voxels where they stand that find room there, the first come in `arrivals` first. The others
/// stay outside, fade by that voxel's looks, and ask again in the next step. `fullRefuse` false: all find room.
/// `targets`: working memory, as long as `arrivals`.
void admit(ShapeParticles& particles, std::span<const std::uint32_t> arrivals, std::span<std::uint32_t> targets,
           std::span<Voxel> voxels, bool fullRefuse);

}  // namespace dustbench::voxel_shape
