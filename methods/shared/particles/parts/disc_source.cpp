#include "methods/shared/particles/parts/disc_source.h"

#include "methods/shared/maths/philox.h"
#include "methods/shared/maths/sampling.h"

namespace dustbench::particles {

PartInfo DiscSource::describe() {
    PartInfo info{PartKind::position, "disc", "a disc on the ground", {}, {}};
    declare(info.parameters);
    info.parameters.real("radius_metres", 0.2, 0, 1e4, "m", "radius of the disc");
    return info;
}

DiscSource::DiscSource(const ParameterValues& values)
    : PlacedSource("disc", values), radiusMetres_(static_cast<float>(values.real("radius_metres"))) {}

void DiscSource::place(Newborns& newborns, const Step& step) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const Emitter& emitter = *newborns.emitter[i];
        const auto u = maths::uniform4(step.seed, positionStream, chunk.serial[i]);
        const glm::vec2 point = radiusMetres_ * maths::discPoint(u[0], u[1]);
        const glm::vec3 position = centreOf(newborns, i) + point.x * emitter.forward + point.y * emitter.right;
        chunk.x[i] = position.x;
        chunk.y[i] = position.y;
        chunk.z[i] = position.z;
    }
}

}  // namespace dustbench::particles
