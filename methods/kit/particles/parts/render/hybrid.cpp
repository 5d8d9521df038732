// A line with a faded old end, and a point at its new end.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::hybrid {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::hybrid;

    static void declare(ParameterSet& set) {
        set.real("pixels", 1, 0, 255, "pixels", "width of the point; 0: three times the radius, by distance")
            .real("seconds", 0, 0, 10, "s", "duration of the path that a line shows; 0: the last step");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.pixels = static_cast<float>(values.real("pixels"));
        look.seconds = static_cast<float>(values.real("seconds"));
        look.fading = true;
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("a point and a fading line for each particle; also shows slow particles",
                                      "Thesis, 4.1.4", Blending::additive);
}

}  // namespace dustbench::particles::parts::render::hybrid
