#include "methods/voxel_shape/particles/field_flow.h"

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/chunk.h"

namespace dustbench::voxel_shape {

void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share) {
    const volumes::VectorSeries::Moment moment = flow.momentAt(timeSeconds);
    particles::ParticleStore& s = moved;
    parallel::forEachBlock(s.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const auto u = moment.at(s.position(i));
            if (!u) continue;
            s.velocityX[i] += share * (u->x - s.velocityX[i]);
            s.velocityY[i] += share * (u->y - s.velocityY[i]);
            s.velocityZ[i] += share * (u->z - s.velocityZ[i]);
        }
    });
}

}  // namespace dustbench::voxel_shape
