// A round puff, the Gaussian of extinction that maths/transmittance.h describes.
#pragma once

#include "methods/shared/particles/render_part.h"

namespace dustbench::particles {

class Puff : public RenderPart {
 public:
    static PartInfo describe() { return {PartKind::render, "puff", "a round puff of dust", {}, {}}; }
    explicit Puff(const ParameterValues& values) : RenderPart("puff", values) {}

    [[nodiscard]] Primitive primitive() const override { return Primitive::puff; }
};

}  // namespace dustbench::particles
