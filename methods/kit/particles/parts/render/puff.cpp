// A round puff: the Gaussian of extinction from maths/transmittance.h.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::puff {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::puff;

    static void declare(ParameterSet&) {}
    static void complete(Look&, const ParameterValues&) {}
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("a round puff of dust", "", Blending::alpha);
}

}  // namespace dustbench::particles::parts::render::puff
