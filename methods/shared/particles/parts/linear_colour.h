// Colour that goes along a straight line from birth to death: (1 − age/lifetime)·start + age/lifetime·end.
//
// Source: Thesis, 4.4.2.
#pragma once

#include "methods/shared/particles/colour_part.h"
#include "methods/shared/particles/parts/opacity_curve.h"

namespace dustbench::particles {

class LinearColour : public ColourPart {
 public:
    static PartInfo describe();
    explicit LinearColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    glm::vec3 start_, end_;
    OpacityCurve opacity_;
};

}  // namespace dustbench::particles
