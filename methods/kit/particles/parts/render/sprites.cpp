// Squares with a picture, all parallel to the image: one orientation, one matrix for all.
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::sprites {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::sprites;

    static void declare(ParameterSet& set) { declarePicture(set); }
    static void complete(Look& look, const ParameterValues& values) { look.picture = pictureOf(values); }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("pictures, all parallel to the image plane", "Thesis, 4.1.5", Blending::additive);
}

}  // namespace dustbench::particles::parts::render::sprites
