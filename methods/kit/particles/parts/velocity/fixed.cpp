// One direction for all: v = (average + R·variation)·D with R in [−1, 1).
//
// Frame of `direction`: the emitter's; x forward, y up, z right.
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::fixed {
namespace {

class FixedVelocity final : public VelocityPart {
 public:
    /// Throws InputError for a direction of zero length.
    explicit FixedVelocity(const ParameterValues& values)
        : VelocityPart(values), direction_(directionOf(values, "direction")), speed_(values) {}

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    glm::vec3 direction_;
    RandomSpeed speed_;
};

void FixedVelocity::launch(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const auto u = maths::uniform4(step.seed, velocityStream, newborns.chunk.serial[i]);
        newborns.setVelocity(i, speed_(u[3]) * newborns.emitter[i]->toWorld(direction_));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "one direction for all";
    info.source = "Thesis, 4.3";
    declareVector(info.parameters, "direction", spaceAxes, {0, 1, 0}, -1, 1, "", "forward, up, right");
    RandomSpeed::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<FixedVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::fixed
