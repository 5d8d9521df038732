// Births distributed uniformly over a disc in the plane of its emitter.
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/placed_source.h"

namespace dustbench::particles::parts::position::disc {
namespace {

class DiscSource final : public PlacedSource {
 public:
    explicit DiscSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    float radiusMetres_;
};

DiscSource::DiscSource(const ParameterValues& values)
    : PlacedSource(values), radiusMetres_(static_cast<float>(values.real("radius_metres"))) {}

void DiscSource::place(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const Emitter& emitter = *newborns.emitter[i];
        const auto u = maths::uniform4(step.seed, positionStream, chunk.serial[i]);
        const glm::vec2 point = radiusMetres_ * maths::discPoint(u[0], u[1]);
        newborns.setPosition(i, newborns.centre(i) + point.x * emitter.forward + point.y * emitter.right);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a disc on the ground";
    info.source = "Thesis, 4.2.4";
    PlacedSource::declare(info.parameters);
    info.parameters.real("radius_metres", 0.2, 0, 1e4, "m", "radius of the disc");
    info.create = [](const ParameterValues& values) { return std::make_unique<DiscSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::disc
