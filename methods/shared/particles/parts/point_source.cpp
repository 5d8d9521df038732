#include "methods/shared/particles/parts/point_source.h"

namespace dustbench::particles {

PartInfo PointSource::describe() {
    PartInfo info{PartKind::position, "point", "a point", {}, {}};
    declare(info.parameters);
    return info;
}

void PointSource::place(Newborns& newborns, const Step&) const {
    const Chunk& chunk = newborns.chunk;
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const glm::vec3 centre = centreOf(newborns, i);
        chunk.x[i] = centre.x;
        chunk.y[i] = centre.y;
        chunk.z[i] = centre.z;
    }
}

}  // namespace dustbench::particles
