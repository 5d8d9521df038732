// The lattice of the particles as a matt surface: cloth, flags, soft bodies.
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::surface {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::surface;

    static void declare(ParameterSet& set) {
        set.integer("squares", 0, 0, 1000, "", "chequers the surface with squares of this many points; 0: one colour")
            .real("dark_share", 0.45, 0, 1, "", "brightness of every second square, relative to the others");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.squares = static_cast<int>(values.integer("squares"));
        look.darkShare = static_cast<float>(values.real("dark_share"));
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe(
        "the surface of a lattice, lit by the scene: one sheet, or the sides of each piece", "Thesis, 5.4.1",
        Blending::alpha);
}

}  // namespace dustbench::particles::parts::render::surface
