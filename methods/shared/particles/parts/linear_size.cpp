#include "methods/shared/particles/parts/linear_size.h"

namespace dustbench::particles {
namespace {

void linearRadius(std::size_t count, const float* __restrict share, float* __restrict radius, float start, float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) radius[i] = start + change * share[i];
}

}  // namespace

PartInfo LinearSize::describe() {
    PartInfo info{PartKind::size, "linear", "from one radius at birth to another at death", {}, {}};
    info.parameters.real("start_metres", 0.25, 0, 1000, "m", "radius at birth")
        .real("end_metres", 1.6, 0, 1000, "m", "radius at death");
    return info;
}

LinearSize::LinearSize(const ParameterValues& values)
    : SizePart("linear", values),
      startMetres_(static_cast<float>(values.real("start_metres"))),
      endMetres_(static_cast<float>(values.real("end_metres"))) {}

void LinearSize::update(Chunk& chunk, const Step&) const {
    linearRadius(chunk.count, chunk.share, chunk.radius, startMetres_, endMetres_);
}

}  // namespace dustbench::particles
