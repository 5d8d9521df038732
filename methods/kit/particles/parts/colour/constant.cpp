// One constant colour for all particles: their own, or that of the scene's dust. Opacity changes with age.
#include <algorithm>

#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/part_parameters.h"

namespace dustbench::particles::parts::colour::constant {
namespace {

enum class From { scene, own };
constexpr Choices<From> origins{{"scene", From::scene}, {"own", From::own}};

class ConstantColour final : public ColourPart {
 public:
    explicit ConstantColour(const ParameterValues& values);

    [[nodiscard]] std::optional<glm::vec3> colourOfAll(const Step& step) const override;
    void initialise(Chunk& chunk, const Step& step) const override;
    void update(Chunk& chunk, const Step& step) const override;

 private:
    From from_;
    glm::vec3 colour_;
    OpacityCurve opacity_;
};

ConstantColour::ConstantColour(const ParameterValues& values)
    : ColourPart(values),
      from_(values.choice("from", origins)),
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

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "one constant colour for all particles";
    info.source = "Thesis, 4.4.1";
    info.parameters.choice("from", From::own, origins, "the scene's lit dust, or `colour`");
    declareVector(info.parameters, "colour", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB, if from = own");
    OpacityCurve::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<ConstantColour>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::colour::constant
