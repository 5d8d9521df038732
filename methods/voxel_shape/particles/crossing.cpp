#include "methods/voxel_shape/particles/crossing.h"

#include <atomic>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {

std::size_t drawAlong(ShapeSystem& moved, const ShapeSystem& by, float share) {
    const Pose& pose = by.pose();
    const VoxelGrid& grid = by.grid();
    const Lattice& lattice = grid.lattice();
    particles::ParticleStore& s = moved.particles().store;
    std::atomic<std::size_t> met{0};
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        std::size_t found = 0;
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::vec3 place = s.position(i);
            const glm::vec3 at = lattice.toVoxels(pose.toLocal(place));
            if (glm::any(glm::lessThan(at, glm::vec3(0))) ||
                glm::any(glm::greaterThanEqual(at, glm::vec3(lattice.counts))) || !grid.at(glm::ivec3(at)).isOn())
                continue;
            const glm::vec3 own(s.velocityX[i], s.velocityY[i], s.velocityZ[i]);
            const glm::vec3 drawn = own + share * (pose.velocityAt(place) - own);
            s.velocityX[i] = drawn.x;
            s.velocityY[i] = drawn.y;
            s.velocityZ[i] = drawn.z;
            ++found;
        }
        met += found;
    });
    return met;
}

}  // namespace dustbench::voxel_shape
