// Velocities within a cone, scaled with the vehicle's speed, plus a fraction of the velocity of the source's carrier.
//
//     v = (speed + speed_share·S)·(1 + R·variation)·D + inherit·V
//
// D: within half_angle of `direction`, S: the emitter's speed, V: its velocity, R in [−1, 1). The thesis has (avg +
// R·var)·D; the dependence of the start velocity on the car's speed is from Carr and Geyer.
// Frame of `direction`: the emitter's; x forward, y up, z right.
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::cone {
namespace {

maths::Cone coneOf(const ParameterValues& values) {
    return {values.choice("mode", samplingModes), directionOf(values, "direction"),
            static_cast<float>(values.real("half_angle_degrees") / 360)};
}

class ConeVelocity final : public VelocityPart {
 public:
    /// Throws InputError for a direction of zero length.
    explicit ConeVelocity(const ParameterValues& values);

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    maths::Cone cone_;
    float speed_, speedShare_, variation_, inherit_;
};

ConeVelocity::ConeVelocity(const ParameterValues& values)
    : VelocityPart(values),
      cone_(coneOf(values)),
      speed_(static_cast<float>(values.real("speed"))),
      speedShare_(static_cast<float>(values.real("speed_share"))),
      variation_(static_cast<float>(values.real("variation"))),
      inherit_(static_cast<float>(values.real("inherit"))) {}

void ConeVelocity::launch(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const Emitter& emitter = *newborns.emitter[i];
        const auto u = maths::uniform4(step.seed, velocityStream, chunk.serial[i]);
        const glm::vec3 direction = emitter.toWorld(cone_.direction(u[0], u[1]));
        const float speed = (speed_ + speedShare_ * emitter.speed) * (1 + variation_ * maths::centred(u[2]));
        const glm::vec3 carrier = glm::mix(emitter.velocityFrom, emitter.velocityTo, newborns.moment[i]);
        newborns.setVelocity(i, speed * direction + inherit_ * carrier);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "within a cone; the speed can grow with the vehicle's";
    info.source = "Thesis, 4.3.1 and 4.3.2; Carr2006, 2.1";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: angle √R·half_angle; fixed: uniform over the cone, its cosine interpolated");
    declareVector(info.parameters, "direction", spaceAxes, {0, 1, 0}, -1, 1, "", "axis: forward, up, right");
    info.parameters.real("half_angle_degrees", 30, 0, 180, "°", "half the cone's opening")
        .real("speed", 1, 0, 1000, "m/s", "along the cone, independent of the vehicle")
        .real("speed_share", 0, 0, 10, "", "share of the vehicle's speed, added to `speed`")
        .real("variation", 0.5, 0, 1, "", "maximum deviation from that speed, relative")
        .real("inherit", 0, -10, 10, "", "share of the emitter's own velocity that particles keep");
    info.create = [](const ParameterValues& values) { return std::make_unique<ConeVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::cone
