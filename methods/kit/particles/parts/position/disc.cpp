// Births distributed uniformly over a disc in the plane of its emitter.
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::position::disc {
namespace {

class DiscSource final : public PlacedSource {
 public:
    explicit DiscSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    float radiusMetres_;
    maths::Tangents axes_;  ///< of the disc, in the emitter's frame
};

/// A horizontal disc has the emitter's own axes.
maths::Tangents axesOf(const glm::vec3& normal) {
    return normal == glm::vec3(0, 1, 0) ? maths::Tangents{{1, 0, 0}, {0, 0, 1}} : maths::tangentsOf(normal);
}

DiscSource::DiscSource(const ParameterValues& values)
    : PlacedSource(values),
      radiusMetres_(static_cast<float>(values.real("radius_metres"))),
      axes_(axesOf(directionOf(values, "normal"))) {}

void DiscSource::place(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const Emitter& emitter = *newborns.emitter[i];
        const auto u = maths::uniform4(step.seed, positionStream, chunk.serial[i]);
        const glm::vec2 point = radiusMetres_ * maths::discPoint(u[0], u[1]);
        const glm::vec3 first = emitter.toWorld(axes_.first), second = emitter.toWorld(axes_.second);
        newborns.setPosition(i, newborns.centre(i) + point.x * first + point.y * second);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a disc, flat on the ground or inclined";
    info.source = "Thesis, 4.2.4";
    PlacedSource::declare(info.parameters);
    info.parameters.real("radius_metres", 0.2, 0, 1e4, "m", "radius of the disc");
    declareVector(info.parameters, "normal", spaceAxes, {0, 1, 0}, -1, 1, "",
                  "normal of the disc: forward, up, right of its emitter");
    info.create = [](const ParameterValues& values) { return std::make_unique<DiscSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::disc
