// A constant downward acceleration: gravity minus buoyancy.
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::force::gravity {
namespace {

void fall(std::size_t count, float* __restrict accelerationY, float acceleration) {
    for (std::size_t i = 0; i < count; ++i) accelerationY[i] -= acceleration;
}

class Gravity final : public ForcePart {
 public:
    explicit Gravity(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;

 private:
    float acceleration_;
};

Gravity::Gravity(const ParameterValues& values)
    : ForcePart(values), acceleration_(static_cast<float>(values.real("acceleration"))) {}

void Gravity::push(Chunk& chunk, const Step&) const {
    fall(chunk.count, chunk.accelerationY, acceleration_);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a constant acceleration downwards";
    info.source = "Thesis, 5.2.1";
    info.parameters.real("acceleration", 9.8, -1000, 1000, "m/s²", "downwards; below 9.8 with buoyancy");
    info.create = [](const ParameterValues& values) { return std::make_unique<Gravity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::gravity
