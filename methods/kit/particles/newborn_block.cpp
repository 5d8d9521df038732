#include "methods/kit/particles/newborn_block.h"

#include <algorithm>

namespace dustbench::particles {

Newborns NewbornBlock::newborns(std::size_t first, std::size_t count, std::uint64_t serial, const Births& births,
                                std::span<const Emitter> emitters, double stepSeconds) {
    Chunk chunk;
    chunk.count = count;
    chunk.serial = serial_.data();
    std::size_t next = 0;
    for (float** column :
         {&chunk.x, &chunk.y, &chunk.z, &chunk.velocityX, &chunk.velocityY, &chunk.velocityZ, &chunk.age,
          &chunk.lifetime, &chunk.radius, &chunk.opacity, &chunk.red, &chunk.green, &chunk.blue})
        *column = columns_[next++].data();
    std::size_t turn = serial % emitters.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double at = births.firstSeconds + static_cast<double>(first + i) * births.spacingSeconds;
        const double born = std::clamp(at, 0.0, stepSeconds);  // rounding may put the last birth slightly after the end
        serial_[i] = serial + i;
        emitter_[i] = &emitters[turn];
        turn = turn + 1 < emitters.size() ? turn + 1 : 0;
        moment_[i] = static_cast<float>(born / stepSeconds);
        chunk.age[i] = static_cast<float>(stepSeconds - born);
    }
    return {chunk, moment_.data(), emitter_.data()};
}

}  // namespace dustbench::particles
