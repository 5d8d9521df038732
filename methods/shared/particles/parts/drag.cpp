#include "methods/shared/particles/parts/drag.h"

#include <algorithm>

namespace dustbench::particles {
namespace {

void resist(std::size_t count, const float* __restrict air, const float* __restrict velocity,
            float* __restrict acceleration, float rate) {
    for (std::size_t i = 0; i < count; ++i) acceleration[i] += rate * (air[i] - velocity[i]);
}

}  // namespace

PartInfo Drag::describe() {
    PartInfo info{PartKind::force, "drag", "resistance of the air, towards its velocity", {}, {}};
    info.parameters.real("rate_per_second", 1, 0, 1e6, "1/s", "how fast particles take on the air's velocity");
    return info;
}

Drag::Drag(const ParameterValues& values) : ForcePart("drag", values), ratePerSecond_(values.real("rate_per_second")) {}

void Drag::push(Chunk& chunk, const Step& step) const {
    const float rate = static_cast<float>(std::min(ratePerSecond_, 1 / step.seconds));
    resist(chunk.count, chunk.airX, chunk.velocityX, chunk.accelerationX, rate);
    resist(chunk.count, chunk.airY, chunk.velocityY, chunk.accelerationY, rate);
    resist(chunk.count, chunk.airZ, chunk.velocityZ, chunk.accelerationZ, rate);
}

}  // namespace dustbench::particles
