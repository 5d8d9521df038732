// Around an axis through the source's centre: v = (average + R·variation + √(k·f(s)·d²/s))·t, with t = axis × r / |axis
// × r|.
//
// The root is the speed of a circular orbit at distance d about an attractor of the same law, strength k and softening
// (attraction.h), for particles in the plane through the centre. A particle born on the axis stays at rest.
#include <cmath>

#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/attraction.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::velocity::orbit {
namespace {

class OrbitVelocity final : public VelocityPart {
 public:
    explicit OrbitVelocity(const ParameterValues& values);

    void launch(Newborns& newborns, const Step& step) const override;

 private:
    [[nodiscard]] float circularSpeed(float distance) const;

    glm::vec3 axis_;
    RandomSpeed speed_;
    AttractionLaw law_;
    float strength_, softeningMetres_;
};

OrbitVelocity::OrbitVelocity(const ParameterValues& values)
    : VelocityPart(values),
      axis_(directionOf(values, "axis")),
      speed_(values),
      law_(values.choice("law", attractionLaws)),
      strength_(static_cast<float>(values.real("strength"))),
      softeningMetres_(static_cast<float>(values.real("softening_metres"))) {}

/// v²/d = k·f(s)·d/s, s² = d² + ε². 0 where the law repels.
float OrbitVelocity::circularSpeed(float distance) const {
    float pull = 0;
    withLaw(law_, [&]<AttractionLaw law>() {
        pull = strength_ * pullPerMetre<law>(distance * distance + softeningMetres_ * softeningMetres_);
    });
    return pull > 0 ? distance * std::sqrt(pull) : 0.0f;
}

void OrbitVelocity::launch(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const auto u = maths::uniform4(step.seed, velocityStream, chunk.serial[i]);
        const glm::vec3 from = glm::vec3(chunk.x[i], chunk.y[i], chunk.z[i]) - newborns.centre(i);
        const glm::vec3 along = glm::cross(axis_, from);
        const float length = glm::length(along);
        const float speed = speed_(u[3]) + circularSpeed(glm::length(from));
        newborns.setVelocity(i, length > 0 ? speed / length * along : glm::vec3(0));
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "around an axis through the source's centre, in circular orbits around an attractor there";
    info.source = "Thesis, 5.2.2; Plummer1911";
    declareVector(info.parameters, "axis", spaceAxes, {0, 1, 0}, -1, 1, "",
                  "axis of rotation, counter-clockwise seen from its tip");
    info.parameters.real("speed", 0, -1000, 1000, "m/s", "mean speed, added to the orbital speed")
        .real("variation", 0, 0, 1000, "m/s", "maximum deviation from the mean")
        .choice("law", AttractionLaw::inverseSquare, attractionLaws, attractionLawHelp)
        .real("strength", 10, 0, 1e6, "", "k of the attractor; 0: no orbit, only `speed`")
        .real("softening_metres", 0.05, 1e-3, 1e4, "m", "ε of the attractor");
    info.create = [](const ParameterValues& values) { return std::make_unique<OrbitVelocity>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::velocity::orbit
