// Squares with a picture, all parallel to the image: one orientation, one matrix for all.
#include "methods/contract/errors.h"
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::sprites {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::sprites;

    static void declare(ParameterSet& set) {
        declarePicture(set);
        set.real("frames_per_second", 0, 0, 240, "1/s",
                 "plays a strip as a looped video, each sprite from its own frame on; 0: a sprite shows one picture of "
                 "the strip");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.picture = pictureOf(values);
        look.framesPerSecond = static_cast<float>(values.real("frames_per_second"));
        if (look.framesPerSecond > 0 && look.picture.empty())
            throw InputError("parameter frames_per_second: got " + values.canonical().at("frames_per_second") +
                             " with picture=gaussian, allowed: 0, or a picture that is a strip of frames");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("pictures, all parallel to the image plane", "Thesis, 4.1.5", Blending::additive);
}

}  // namespace dustbench::particles::parts::render::sprites
