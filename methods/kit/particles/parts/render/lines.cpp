// Lines one pixel wide along the path of the last step: straight back along the velocity, at most back to the birth.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::lines {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::lines;

    static void declare(ParameterSet& set) {
        set.real("seconds", 0, 0, 10, "s", "duration of the path that a line shows; 0: the last step")
            .boolean("fade", true, "makes the old end transparent");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.seconds = static_cast<float>(values.real("seconds"));
        look.fading = values.boolean("fade");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("lines from the old position to the new one", "Thesis, 4.1.3",
                                      Blending::additive);
}

}  // namespace dustbench::particles::parts::render::lines
