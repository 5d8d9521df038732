// A point that attracts all particles: a = k·f(d)·r/d, or repels them if k < 0.
#include "methods/kit/particles/attraction.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::force::attractor {
namespace {

template <AttractionLaw law>
void attract(const Chunk& chunk, float* __restrict accelerationX, float* __restrict accelerationY,
             float* __restrict accelerationZ, const glm::vec3 place, float strength, float softening2) {
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const float x = place.x - chunk.x[i], y = place.y - chunk.y[i], z = place.z - chunk.z[i];
        const float pull = strength * pullPerMetre<law>(x * x + y * y + z * z + softening2);
        accelerationX[i] += pull * x;
        accelerationY[i] += pull * y;
        accelerationZ[i] += pull * z;
    }
}

class Attractor final : public ForcePart {
 public:
    explicit Attractor(const ParameterValues& values);

    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::optional<Mark> mark() const override { return markOf(values(), {MarkShape::cross, place_}); }

 private:
    AttractionLaw law_;
    glm::vec3 place_;
    float strength_, softeningMetres_;
};

Attractor::Attractor(const ParameterValues& values)
    : ForcePart(values),
      law_(values.choice("law", attractionLaws)),
      place_(vectorOf(values, "place", spaceAxes)),
      strength_(static_cast<float>(values.real("strength"))),
      softeningMetres_(static_cast<float>(values.real("softening_metres"))) {}

void Attractor::push(Chunk& chunk, const Step&) const {
    withLaw(law_, [&]<AttractionLaw law>() {
        attract<law>(chunk, chunk.accelerationX, chunk.accelerationY, chunk.accelerationZ, place_, strength_,
                     softeningMetres_ * softeningMetres_);
    });
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a point that attracts particles; 0 at the point itself, largest near the softening length";
    info.source = "Thesis, 5.2.2; Plummer1911";
    info.parameters.choice("law", AttractionLaw::inverseSquare, attractionLaws, attractionLawHelp);
    declareVector(info.parameters, "place", spaceAxes, {0, 0, 0}, -1e6, 1e6, "m", "position of the point in the world");
    info.parameters.real("strength", 10, -1e6, 1e6, "", "k: the acceleration in m/s² where f is 1; negative: repulsion")
        .real("softening_metres", 0.05, 1e-3, 1e4, "m",
              "ε: limits the attraction at small distances, since f is infinite at d = 0");
    declareMark(info.parameters, "a cross", {0.2, 0.8, 0.3});
    info.create = [](const ParameterValues& values) { return std::make_unique<Attractor>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::attractor
