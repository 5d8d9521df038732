// A coloured light at a point: luminosity += min(I·f(d), maximum)·colour, where f is 1/d², or 1/d³ in rain or fog.
//
// The thesis limits the luminosity so that colours stay valid; here each light's share is limited, which also defines
// it at d = 0.
#include <cmath>

#include "methods/contract/choices.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/shading_part.h"

namespace dustbench::particles::parts::shading::light {
namespace {

enum class Falloff { square, cube };
constexpr Choices<Falloff> falloffs{{"1/d2", Falloff::square}, {"1/d3", Falloff::cube}};

template <Falloff falloff>
void illuminate(std::size_t count, const float* __restrict x, const float* __restrict y, const float* __restrict z,
                float* __restrict red, float* __restrict green, float* __restrict blue, const glm::vec3 place,
                const glm::vec3 colour, float intensity, float maximum) {
    // I/dⁿ > maximum where dⁿ < I/maximum.
    const float nearest = intensity / maximum;
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = x[i] - place.x, dy = y[i] - place.y, dz = z[i] - place.z;
        const float d2 = dx * dx + dy * dy + dz * dz;
        const float power = falloff == Falloff::cube ? d2 * std::sqrt(d2) : d2;
        const float luminosity = power > nearest ? intensity / power : maximum;
        red[i] += luminosity * colour.r;
        green[i] += luminosity * colour.g;
        blue[i] += luminosity * colour.b;
    }
}

class Light final : public ShadingPart {
 public:
    explicit Light(const ParameterValues& values)
        : ShadingPart(values),
          place_(vectorOf(values, "place", spaceAxes)),
          colour_(vectorOf(values, "colour", colourAxes)),
          falloff_(values.choice("falloff", falloffs)),
          intensity_(static_cast<float>(values.real("intensity"))),
          maximum_(static_cast<float>(values.real("maximum"))) {}

    void shade(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::optional<Mark> mark() const override { return markOf(values(), {MarkShape::cross, place_}); }

 private:
    glm::vec3 place_, colour_;
    Falloff falloff_;
    float intensity_, maximum_;
};

void Light::shade(Chunk& chunk, const Step&) const {
    const auto add = falloff_ == Falloff::cube ? illuminate<Falloff::cube> : illuminate<Falloff::square>;
    add(chunk.count, chunk.x, chunk.y, chunk.z, chunk.luminosityRed, chunk.luminosityGreen, chunk.luminosityBlue,
        place_, colour_, intensity_, maximum_);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a coloured light at a point, without shadows";
    info.source = "Thesis, 6.2.3";
    declareVector(info.parameters, "place", spaceAxes, {0, 3, 0}, -1e6, 1e6, "m", "position of the light in the world");
    declareVector(info.parameters, "colour", colourAxes, {1, 1, 1}, 0, 100, "", "linear RGB");
    info.parameters
        .choice("falloff", Falloff::square, falloffs,
                "how the luminosity falls with the distance; 1/d3: through rain or fog")
        .real("intensity", 4, 0, 1e6, "m² or m³", "I: the luminosity at a distance of 1 m")
        .real("maximum", 1, 1e-3, 1e3, "", "maximum luminosity from this light, reached near it");
    declareMark(info.parameters, "a cross", {1, 0.9, 0.4});
    info.create = [](const ParameterValues& values) { return std::make_unique<Light>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::shading::light
