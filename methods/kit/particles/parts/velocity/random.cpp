// Any direction: v = (average + R·variation)·D with R in [−1, 1).
//
// paper: D is a vector of three random components, normalised, which favours a cube's corners. fixed: D is uniform.
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::random {
namespace {

class RandomVelocity final : public VelocityPart {
 public:
    explicit RandomVelocity(const ParameterValues& values)
        : VelocityPart(values), mode_(values.choice("mode", samplingModes)), speed_(values) {}

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    maths::SamplingMode mode_;
    RandomSpeed speed_;
};

void RandomVelocity::launch(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const auto u = maths::uniform4(step.seed, velocityStream, newborns.chunk.serial[i]);
        const glm::vec3 direction = mode_ == maths::SamplingMode::paper ? maths::cubeDirection(u[0], u[1], u[2])
                                                                        : maths::sphereDirection(u[0], u[1]);
        newborns.setVelocity(i, speed_(u[3]) * direction);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "any direction";
    info.source = "Thesis, 4.3.1";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: a normalised random vector, up to 5.2 times denser towards a cube's corners; "
                           "fixed: uniform");
    RandomSpeed::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<RandomVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::random
