#include "methods/shared/particles/parts/constant_size.h"

#include <algorithm>

namespace dustbench::particles {

PartInfo ConstantSize::describe() {
    PartInfo info{PartKind::size, "constant", "one radius for all, all their life", {}, {}};
    info.parameters.real("radius_metres", 0.5, 0, 1000, "m", "radius");
    return info;
}

ConstantSize::ConstantSize(const ParameterValues& values)
    : SizePart("constant", values), radiusMetres_(static_cast<float>(values.real("radius_metres"))) {}

void ConstantSize::initialise(Chunk& chunk, const Step&) const {
    std::fill_n(chunk.radius, chunk.count, radiusMetres_);
}

}  // namespace dustbench::particles
