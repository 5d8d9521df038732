// One colour for all particles, all their life: their own, or what the scene's dust shows. Opacity goes with age.
//
// Source: Thesis, 4.4.1.
#pragma once

#include "methods/shared/particles/colour_part.h"
#include "methods/shared/particles/parts/opacity_curve.h"

namespace dustbench::particles {

class ConstantColour : public ColourPart {
 public:
    static PartInfo describe();
    explicit ConstantColour(const ParameterValues& values);

    [[nodiscard]] std::optional<glm::vec3> colourOfAll(const Step& step) const override;
    void initialise(Chunk& chunk, const Step& step) const override;
    void update(Chunk& chunk, const Step& step) const override;

 private:
    enum class From { scene, own };

    From from_;
    glm::vec3 colour_;
    OpacityCurve opacity_;
};

}  // namespace dustbench::particles
