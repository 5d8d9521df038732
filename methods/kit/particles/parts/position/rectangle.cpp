// Births distributed uniformly over a rectangle in the plane of its emitter.
//
// Frame of `normal`: the emitter's; x forward, y up, z right.
#include "methods/kit/maths/philox.h"
#include "methods/kit/maths/sampling.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::position::rectangle {
namespace {

class RectangleSource final : public PlacedSource {
 public:
    explicit RectangleSource(const ParameterValues& values);

    void place(Newborns& newborns, const Step& step) const override;

 private:
    float lengthMetres_, widthMetres_;
    maths::Tangents sides_;  ///< along length and width, in the emitter's frame
};

/// A horizontal rectangle has the emitter's own axes.
maths::Tangents sidesOf(const glm::vec3& normal) {
    return normal == glm::vec3(0, 1, 0) ? maths::Tangents{{1, 0, 0}, {0, 0, 1}} : maths::tangentsOf(normal);
}

RectangleSource::RectangleSource(const ParameterValues& values)
    : PlacedSource(values),
      lengthMetres_(static_cast<float>(values.real("length_metres"))),
      widthMetres_(static_cast<float>(values.real("width_metres"))),
      sides_(sidesOf(directionOf(values, "normal"))) {}

void RectangleSource::place(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const Emitter& emitter = *newborns.emitter[i];
        const auto u = maths::uniform4(step.seed, positionStream, chunk.serial[i]);
        const glm::vec3 along = emitter.toWorld(sides_.first), across = emitter.toWorld(sides_.second);
        newborns.setPosition(
            i, newborns.centre(i) + (u[0] - 0.5f) * lengthMetres_ * along + (u[1] - 0.5f) * widthMetres_ * across);
    }
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a rectangle, flat on the ground or inclined";
    info.source = "Senger2009, 5";
    PlacedSource::declare(info.parameters);
    info.parameters.real("length_metres", 1, 0, 1e4, "m", "side along its emitter's forward direction if it is flat")
        .real("width_metres", 1, 0, 1e4, "m", "side to the right");
    declareVector(info.parameters, "normal", spaceAxes, {0, 1, 0}, -1, 1, "",
                  "normal of the rectangle: forward, up, right of its emitter");
    info.create = [](const ParameterValues& values) { return std::make_unique<RectangleSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::rectangle
