#include "methods/shared/particles/parts/bezier_colour.h"

#include "methods/shared/particles/vector_parameter.h"

namespace dustbench::particles {
namespace {

void bezierChannel(std::size_t count, const float* __restrict share, float* __restrict channel,
                   const maths::CubicPolynomial<float> curve) {
    for (std::size_t i = 0; i < count; ++i) {
        const float value = curve(share[i]);
        channel[i] = value > 0.0f ? value : 0.0f;
    }
}

}  // namespace

PartInfo BezierColour::describe() {
    PartInfo info{PartKind::colour, "bezier", "along a cubic curve of four colours", {}, {}};
    declareVector(info.parameters, "start", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at birth");
    declareVector(info.parameters, "early", colourAxes, {1, 1, 1}, 0, 100, "", "second control colour");
    declareVector(info.parameters, "late", colourAxes, {1, 1, 1}, 0, 100, "", "third control colour");
    declareVector(info.parameters, "end", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at death");
    OpacityCurve::declare(info.parameters);
    return info;
}

BezierColour::BezierColour(const ParameterValues& values) : ColourPart("bezier", values), opacity_(values) {
    const glm::vec3 start = vectorOf(values, "start", colourAxes), early = vectorOf(values, "early", colourAxes),
                    late = vectorOf(values, "late", colourAxes), end = vectorOf(values, "end", colourAxes);
    for (int i = 0; i < 3; ++i)
        channels_[static_cast<std::size_t>(i)] = maths::bezierPolynomial(start[i], early[i], late[i], end[i]);
}

void BezierColour::update(Chunk& chunk, const Step&) const {
    bezierChannel(chunk.count, chunk.share, chunk.red, channels_[0]);
    bezierChannel(chunk.count, chunk.share, chunk.green, channels_[1]);
    bezierChannel(chunk.count, chunk.share, chunk.blue, channels_[2]);
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace dustbench::particles
