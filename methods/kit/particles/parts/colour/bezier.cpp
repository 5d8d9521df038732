// Colour along a cubic Bézier curve of four control colours, from birth to death.
//
// fixed: evaluates the curve as a polynomial in t (maths/bezier.h), which equals de Casteljau's result. paper: the
// printed weights, (N − t)^(N−i)·t^i, which make the colour at birth 27 times the first one.
#include <array>

#include "methods/kit/maths/bezier.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::colour::bezier {
namespace {

void bezierChannel(std::size_t count, const float* __restrict share, float* __restrict channel,
                   const maths::CubicPolynomial<float> curve) {
    for (std::size_t i = 0; i < count; ++i) {
        const float value = curve(share[i]);
        channel[i] = value > 0.0f ? value : 0.0f;
    }
}

class BezierColour final : public ColourPart {
 public:
    explicit BezierColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    std::array<maths::CubicPolynomial<float>, 3> channels_;
    OpacityCurve opacity_;
};

BezierColour::BezierColour(const ParameterValues& values)
    : ColourPart(values), opacity_(values, values.choice("mode", samplingModes)) {
    const bool printed = values.choice("mode", samplingModes) == maths::SamplingMode::paper;
    const glm::vec3 start = vectorOf(values, "start", colourAxes), early = vectorOf(values, "early", colourAxes),
                    late = vectorOf(values, "late", colourAxes), end = vectorOf(values, "end", colourAxes);
    for (int i = 0; i < 3; ++i)
        channels_[static_cast<std::size_t>(i)] =
            printed ? maths::printedBezierPolynomial(start[i], early[i], late[i], end[i])
                    : maths::bezierPolynomial(start[i], early[i], late[i], end[i]);
}

void BezierColour::update(Chunk& chunk, const Step&) const {
    bezierChannel(chunk.count, chunk.share, chunk.red, channels_[0]);
    bezierChannel(chunk.count, chunk.share, chunk.green, channels_[1]);
    bezierChannel(chunk.count, chunk.share, chunk.blue, channels_[2]);
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "along a cubic curve of four colours";
    info.source = "Thesis, 4.4.3";
    info.parameters.choice("mode", maths::SamplingMode::fixed, samplingModes,
                           "paper: the printed weights (N − t), 27 times too bright at birth; fixed: (1 − t)");
    declareVector(info.parameters, "start", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at birth");
    declareVector(info.parameters, "early", colourAxes, {1, 1, 1}, 0, 100, "", "second control colour");
    declareVector(info.parameters, "late", colourAxes, {1, 1, 1}, 0, 100, "", "third control colour");
    declareVector(info.parameters, "end", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at death");
    OpacityCurve::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<BezierColour>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::colour::bezier
