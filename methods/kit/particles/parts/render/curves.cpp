// Curves one pixel wide through the positions of the last steps, at most to the birth. Lines approximate them.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::curves {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::curves;

    static void declare(ParameterSet& set) {
        set.integer("steps", 1, 1, 30, "", "of the path that a curve shows")
            .integer("pieces", 4, 1, 32, "", "straight pieces that each step is drawn with")
            .boolean("fade", true, "the old end is transparent");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.steps = static_cast<int>(values.integer("steps"));
        look.pieces = static_cast<int>(values.integer("pieces"));
        look.fading = values.boolean("fade");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("curves through the last positions, which lines approximate", "Thesis, 4.1.3",
                                      Blending::additive);
}

}  // namespace dustbench::particles::parts::render::curves
