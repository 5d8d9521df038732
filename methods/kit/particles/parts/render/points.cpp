// Points with a width in pixels, or with the particle's own size.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::points {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::points;

    static void declare(ParameterSet& set) {
        set.real("pixels", 2, 0, 255, "pixels", "width; 0: three times the radius, by distance")
            .boolean("round", false, "a Gaussian profile instead of a flat square");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.pixels = static_cast<float>(values.real("pixels"));
        look.round = values.boolean("round");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("points, the fastest to draw", "Thesis, 4.1.2", Blending::additive);
}

}  // namespace dustbench::particles::parts::render::points
