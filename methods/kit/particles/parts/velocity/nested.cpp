// Between two nested cones: v = (average + R·variation)·D with R in [−1, 1).
//
// paper: β = βmin + √R·(βmax − βmin). fixed: uniform on the zone between them, its cosine interpolated.
// Frame of `direction`: the emitter's; x forward, y up, z right.
#include "methods/contract/errors.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::nested {
namespace {

maths::Cone coneOf(const ParameterValues& values) {
    const double outer = values.real("half_angle_degrees"), inner = values.real("inner_half_angle_degrees");
    if (inner > outer)
        throw InputError(
            "parameter inner_half_angle_degrees: got " + values.canonical().find("inner_half_angle_degrees")->second +
            ", allowed: at most half_angle_degrees, " + values.canonical().find("half_angle_degrees")->second);
    return {values.choice("mode", samplingModes), directionOf(values, "direction"), static_cast<float>(outer / 360),
            static_cast<float>(inner / 360)};
}

class NestedVelocity final : public VelocityPart {
 public:
    /// Throws InputError for a direction of zero length, or if the inner cone is wider than the outer one.
    explicit NestedVelocity(const ParameterValues& values)
        : VelocityPart(values), cone_(coneOf(values)), speed_(values) {}

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    maths::Cone cone_;
    RandomSpeed speed_;
};

void NestedVelocity::launch(Newborns& newborns, const Step& step) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) {
        const auto u = maths::uniform4(step.seed, velocityStream, newborns.chunk.serial[i]);
        newborns.setVelocity(i, speed_(u[3]) * newborns.emitter[i]->toWorld(cone_.direction(u[0], u[1])));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "between two nested cones";
    info.source = "Thesis, 4.3.3";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: angle inner + √R·(outer − inner); fixed: uniform between the cones");
    declareVector(info.parameters, "direction", spaceAxes, {0, 1, 0}, -1, 1, "", "axis: forward, up, right");
    info.parameters.real("inner_half_angle_degrees", 20, 0, 180, "°", "half the inner cone's opening")
        .real("half_angle_degrees", 30, 0, 180, "°", "half the outer cone's opening");
    RandomSpeed::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<NestedVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::nested
