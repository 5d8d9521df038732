// Colour that goes along a cubic Bézier curve of four control colours from birth to death.
//
// Source: Thesis, 4.4.3. Departs: the curve is a polynomial in t (maths/bezier.h), which equals de Casteljau's points.
#pragma once

#include <array>

#include "methods/shared/maths/bezier.h"
#include "methods/shared/particles/colour_part.h"
#include "methods/shared/particles/parts/opacity_curve.h"

namespace dustbench::particles {

class BezierColour : public ColourPart {
 public:
    static PartInfo describe();
    explicit BezierColour(const ParameterValues& values);

    void initialise(Chunk& chunk, const Step& step) const override { update(chunk, step); }
    void update(Chunk& chunk, const Step& step) const override;

 private:
    std::array<maths::CubicPolynomial<float>, 3> channels_;
    OpacityCurve opacity_;
};

}  // namespace dustbench::particles
