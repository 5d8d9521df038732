#include "methods/shared/particles/parts/constant_colour.h"

#include <algorithm>

#include "methods/shared/particles/vector_parameter.h"

namespace dustbench::particles {

PartInfo ConstantColour::describe() {
    PartInfo info{PartKind::colour, "constant", "one colour for all, all their life", {}, {}};
    info.parameters.choice("from", "own", {"scene", "own"}, "the scene's lit dust, or `colour`");
    declareVector(info.parameters, "colour", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB, where from = own");
    OpacityCurve::declare(info.parameters);
    return info;
}

ConstantColour::ConstantColour(const ParameterValues& values)
    : ColourPart("constant", values),
      from_(values.choiceAs<From>("from")),
      colour_(vectorOf(values, "colour", colourAxes)),
      opacity_(values) {}

std::optional<glm::vec3> ConstantColour::colourOfAll(const Step& step) const {
    return from_ == From::own ? colour_ : scene::dustColour(step.scene);
}

void ConstantColour::initialise(Chunk& chunk, const Step& step) const {
    update(chunk, step);
    if (!chunk.hasColours()) return;
    const glm::vec3 colour = *colourOfAll(step);
    std::fill_n(chunk.red, chunk.count, colour.r);
    std::fill_n(chunk.green, chunk.count, colour.g);
    std::fill_n(chunk.blue, chunk.count, colour.b);
}

void ConstantColour::update(Chunk& chunk, const Step&) const {
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace dustbench::particles
