// Particles that emit light and light their surroundings: luminosity += 1 for the particles, and a few
// lamps for the scene (shading_part.h).
#include "methods/kit/particles/shading_part.h"

namespace dustbench::particles::parts::shading::glow {
namespace {

void brighten(std::size_t count, float* __restrict luminosity) {
    for (std::size_t i = 0; i < count; ++i) luminosity[i] += 1.0f;
}

class Glowing final : public ShadingPart {
 public:
    explicit Glowing(const ParameterValues& values)
        : ShadingPart(values),
          glow_{static_cast<int>(values.integer("lights")), static_cast<float>(values.real("strength")),
                values.choice("by", glowWords)} {}

    void shade(Chunk& chunk, const Step&) const override {
        brighten(chunk.count, chunk.luminosityRed);
        brighten(chunk.count, chunk.luminosityGreen);
        brighten(chunk.count, chunk.luminosityBlue);
    }
    [[nodiscard]] std::optional<Glow> glow() const override { return glow_; }

 private:
    Glow glow_;
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "particles emit light, which falls on the ground, the solids and the car";
    info.source = "Thesis, 6.3";
    info.parameters.integer("lights", 1, 1, 16, "", "number of point lights that replace the particles, in groups")
        .choice("by", GlowBy::age, glowWords,
                "equal intervals of what a group has: of age/lifetime, of place along the longest edge of the system's "
                "box, or of luminosity")
        .real("strength", 20, 0, 1e6, "1/m", "k: a light's intensity is k·Σ colour·opacity·radius³, in m²");
    info.create = [](const ParameterValues& values) { return std::make_unique<Glowing>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::shading::glow
