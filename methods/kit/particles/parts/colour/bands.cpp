// One of two colours for each particle, like ground whose soil changes along the way: consecutive births share a
// colour.
#include "methods/kit/maths/philox.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::colour::bands {
namespace {

class BandedColour final : public ColourPart {
 public:
    explicit BandedColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override;
    void update(Chunk& chunk, const Step& step) const override;

 private:
    glm::vec3 first_, second_;
    std::uint64_t births_;
    float share_;
    OpacityCurve opacity_;
};

BandedColour::BandedColour(const ParameterValues& values)
    : ColourPart(values),
      first_(vectorOf(values, "first", colourAxes)),
      second_(vectorOf(values, "second", colourAxes)),
      births_(static_cast<std::uint64_t>(values.integer("births"))),
      share_(static_cast<float>(values.real("share"))),
      opacity_(values) {}

void BandedColour::initialise(Chunk& chunk, const Step& step) const {
    const std::uint64_t inARow = births_ * static_cast<std::uint64_t>(step.particlesPerPuff);
    for (std::size_t i = 0; i < chunk.count; ++i) {
        const bool isSecond = maths::uniform4(step.seed, colourStream, chunk.serial[i] / inARow)[0] < share_;
        const glm::vec3 colour = isSecond ? second_ : first_;
        chunk.red[i] = colour.r;
        chunk.green[i] = colour.g;
        chunk.blue[i] = colour.b;
    }
    update(chunk, step);
}

void BandedColour::update(Chunk& chunk, const Step&) const {
    opacity_.write(chunk.share, chunk.opacity, chunk.count);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "one of two colours, shared by consecutive births";
    declareVector(info.parameters, "first", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB");
    declareVector(info.parameters, "second", colourAxes, {0, 0, 0}, 0, 100, "", "linear RGB");
    info.parameters.integer("births", 100, 1, 1'000'000'000, "particles", "consecutive births that share a colour")
        .real("share", 0.5, 0, 1, "", "share of the bands with the second colour");
    OpacityCurve::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<BandedColour>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::colour::bands
