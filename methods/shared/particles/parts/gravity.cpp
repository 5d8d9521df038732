#include "methods/shared/particles/parts/gravity.h"

namespace dustbench::particles {
namespace {

void fall(std::size_t count, float* __restrict accelerationY, float acceleration) {
    for (std::size_t i = 0; i < count; ++i) accelerationY[i] -= acceleration;
}

}  // namespace

PartInfo Gravity::describe() {
    PartInfo info{PartKind::force, "gravity", "a constant acceleration downwards", {}, {}};
    info.parameters.real("acceleration", 9.8, -1000, 1000, "m/s²", "downwards; less than 9.8 where the air carries");
    return info;
}

Gravity::Gravity(const ParameterValues& values)
    : ForcePart("gravity", values), acceleration_(static_cast<float>(values.real("acceleration"))) {}

void Gravity::push(Chunk& chunk, const Step&) const {
    fall(chunk.count, chunk.accelerationY, acceleration_);
}

}  // namespace dustbench::particles
