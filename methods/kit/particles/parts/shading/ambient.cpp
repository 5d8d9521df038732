// Light from all sides: the same luminosity for all particles.
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/shading_part.h"

namespace dustbench::particles::parts::shading::ambient {
namespace {

enum class From { scene, colour };
constexpr Choices<From> origins{{"scene", From::scene}, {"colour", From::colour}};

void brighten(std::size_t count, float* __restrict luminosity, float by) {
    for (std::size_t i = 0; i < count; ++i) luminosity[i] += by;
}

class Ambient final : public ShadingPart {
 public:
    explicit Ambient(const ParameterValues& values)
        : ShadingPart(values), from_(values.choice("from", origins)), colour_(vectorOf(values, "colour", colourAxes)) {}

    void shade(Chunk& chunk, const Step& step) const override;

 private:
    From from_;
    glm::vec3 colour_;
};

void Ambient::shade(Chunk& chunk, const Step& step) const {
    const glm::vec3 light = from_ == From::scene ? step.scene.lights.ambient : colour_;
    brighten(chunk.count, chunk.luminosityRed, light.r);
    brighten(chunk.count, chunk.luminosityGreen, light.g);
    brighten(chunk.count, chunk.luminosityBlue, light.b);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "light from all sides";
    info.source = "Thesis, 6.2.2";
    info.parameters.choice("from", From::colour, origins, "the scene's ambient light, or `colour`");
    declareVector(info.parameters, "colour", colourAxes, {0.3, 0.3, 0.3}, 0, 100, "", "linear RGB");
    info.create = [](const ParameterValues& values) { return std::make_unique<Ambient>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::shading::ambient
