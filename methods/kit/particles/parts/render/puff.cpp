// A round puff: the Gaussian of extinction from maths/transmittance.h.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::puff {
namespace {

class Puff final : public RenderPart {
 public:
    explicit Puff(const ParameterValues& values) : RenderPart(values) {}

    [[nodiscard]] Primitive primitive() const override { return Primitive::puff; }
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a round puff of dust";
    info.create = [](const ParameterValues& values) { return std::make_unique<Puff>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::render::puff
