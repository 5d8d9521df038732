// Colour interpolated linearly from birth to death: (1 − age/lifetime)·start + age/lifetime·end.
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::colour::linear {
namespace {

void linearChannel(std::size_t count, const float* __restrict share, float* __restrict channel, float start,
                   float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) channel[i] = start + change * share[i];
}

class LinearColour final : public ColourPart {
 public:
    explicit LinearColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    glm::vec3 start_, end_;
    OpacityCurve opacity_;
};

LinearColour::LinearColour(const ParameterValues& values)
    : ColourPart(values),
      start_(vectorOf(values, "start", colourAxes)),
      end_(vectorOf(values, "end", colourAxes)),
      opacity_(values) {}

void LinearColour::update(Chunk& chunk, const Step&) const {
    linearChannel(chunk.count, chunk.share, chunk.red, start_.r, end_.r);
    linearChannel(chunk.count, chunk.share, chunk.green, start_.g, end_.g);
    linearChannel(chunk.count, chunk.share, chunk.blue, start_.b, end_.b);
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "from one colour at birth to another at death";
    info.source = "Thesis, 4.4.2";
    declareVector(info.parameters, "start", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at birth");
    declareVector(info.parameters, "end", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB at death");
    OpacityCurve::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<LinearColour>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::colour::linear
