#include "methods/voxel_shape/particles/field_flow.h"

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {
namespace {

/// `velocityAt`: u at a point of the world, or none beyond the grid.
template <typename VelocityAt>
void drawAlongField(particles::ParticleStore& s, float share, const VelocityAt& velocityAt) {
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto u = velocityAt(s.position(i));
            if (!u) continue;
            s.velocityX[i] += share * (u->x - s.velocityX[i]);
            s.velocityY[i] += share * (u->y - s.velocityY[i]);
            s.velocityZ[i] += share * (u->z - s.velocityZ[i]);
        }
    });
}

}  // namespace

void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share) {
    const volumes::VectorSeries::Moment moment = flow.momentAt(timeSeconds);
    drawAlongField(moved, share, [&](const glm::vec3& world) { return moment.at(world); });
}

void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, const Pose& pose, double timeSeconds,
               float share) {
    const volumes::VectorSeries::Moment moment = flow.momentAt(timeSeconds);
    drawAlongField(moved, share, [&](const glm::vec3& world) {
        auto u = moment.at(pose.toLocal(world));
        if (u) *u = pose.velocityAt(world) + pose.scale * (pose.rotation * *u);
        return u;
    });
}

}  // namespace dustbench::voxel_shape
