// Curves one pixel wide through the positions of the last steps, at most back to the birth, approximated by lines.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::curves {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::curves;

    static void declare(ParameterSet& set) {
        set.integer("steps", 1, 1, 30, "", "number of steps that a curve shows")
            .integer("pieces", 4, 1, 32, "", "number of straight pieces per step")
            .boolean("fade", true, "makes the old end transparent");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.steps = static_cast<int>(values.integer("steps"));
        look.pieces = static_cast<int>(values.integer("pieces"));
        look.fading = values.boolean("fade");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("curves through the last positions, drawn as lines", "Thesis, 4.1.3",
                                      Blending::additive);
}

}  // namespace dustbench::particles::parts::render::curves
