#include "methods/shared/particles/parts/linear_colour.h"

#include "methods/shared/particles/vector_parameter.h"

namespace dustbench::particles {
namespace {

void linearChannel(std::size_t count, const float* __restrict share, float* __restrict channel, float start,
                   float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) channel[i] = start + change * share[i];
}

}  // namespace

PartInfo LinearColour::describe() {
    PartInfo info{PartKind::colour, "linear", "from one colour at birth to another at death", {}, {}};
    declareVector(info.parameters, "start", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at birth");
    declareVector(info.parameters, "end", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at death");
    OpacityCurve::declare(info.parameters);
    return info;
}

LinearColour::LinearColour(const ParameterValues& values)
    : ColourPart("linear", values),
      start_(vectorOf(values, "start", colourAxes)),
      end_(vectorOf(values, "end", colourAxes)),
      opacity_(values) {}

void LinearColour::update(Chunk& chunk, const Step&) const {
    linearChannel(chunk.count, chunk.share, chunk.red, start_.r, end_.r);
    linearChannel(chunk.count, chunk.share, chunk.green, start_.g, end_.g);
    linearChannel(chunk.count, chunk.share, chunk.blue, start_.b, end_.b);
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace dustbench::particles
