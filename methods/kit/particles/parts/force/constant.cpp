// A constant force on all particles: wind, buoyancy, gravity in any direction.
//
// paper: a = m·F, as printed. fixed: a = F/m (Newton). At the thesis's mass of 1 kg they are equal.
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::force::constant {
namespace {

void accelerate(std::size_t count, float* __restrict acceleration, float by) {
    for (std::size_t i = 0; i < count; ++i) acceleration[i] += by;
}

class ConstantForce final : public ForcePart {
 public:
    explicit ConstantForce(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;

 private:
    glm::vec3 acceleration_;
};

ConstantForce::ConstantForce(const ParameterValues& values) : ForcePart(values) {
    const glm::dvec3 force = vectorOf(values, "force", spaceAxes);
    const double mass = values.real("mass_kilograms");
    acceleration_ = values.choice("mode", samplingModes) == maths::SamplingMode::paper ? force * mass : force / mass;
}

void ConstantForce::push(Chunk& chunk, const Step&) const {
    accelerate(chunk.count, chunk.accelerationX, acceleration_.x);
    accelerate(chunk.count, chunk.accelerationY, acceleration_.y);
    accelerate(chunk.count, chunk.accelerationZ, acceleration_.z);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a constant force in any direction";
    info.source = "Thesis, 5.1 and 5.2.1";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: a = m·F, as printed; fixed: a = F/m");
    declareVector(info.parameters, "force", spaceAxes, {0, -9.8, 0}, -1e6, 1e6, "N", "force on each particle");
    info.parameters.real("mass_kilograms", 1, 1e-6, 1e6, "kg", "mass of each particle");
    info.create = [](const ParameterValues& values) { return std::make_unique<ConstantForce>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::constant
