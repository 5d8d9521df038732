// Away from the source's centre: v = (average + R·variation + speed_per_metre·d)·D, d the distance to the centre.
//
// A particle born exactly at the centre leaves in a random direction, uniform on the sphere.
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::away {
namespace {

class AwayVelocity final : public VelocityPart {
 public:
    explicit AwayVelocity(const ParameterValues& values)
        : VelocityPart(values), speed_(values), speedPerMetre_(static_cast<float>(values.real("speed_per_metre"))) {}

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    RandomSpeed speed_;
    float speedPerMetre_;
};

void AwayVelocity::launch(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const auto u = maths::uniform4(step.seed, velocityStream, chunk.serial[i]);
        const glm::vec3 from = glm::vec3(chunk.x[i], chunk.y[i], chunk.z[i]) - newborns.centre(i);
        const float distance = glm::length(from);
        const glm::vec3 direction = distance > 0 ? from / distance : maths::sphereDirection(u[0], u[1]);
        newborns.setVelocity(i, (speed_(u[3]) + speedPerMetre_ * distance) * direction);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "away from the source's centre; in a random direction if born exactly there";
    info.source = "Thesis, 4.3.4";
    RandomSpeed::declare(info.parameters);
    info.parameters.real("speed_per_metre", 0, -1000, 1000, "1/s", "added per metre between birthplace and centre");
    info.create = [](const ParameterValues& values) { return std::make_unique<AwayVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::away
