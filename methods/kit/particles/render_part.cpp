#include "methods/kit/particles/render_part.h"

namespace dustbench::particles {

void RenderPart::declareBlending(ParameterSet& set, Blending initial) {
    set.choice("blend", initial, blendings, "cover the background, sorted far to near; or add light, in any order")
        .boolean("clamped", true, "clamps added light to 1 in a separate buffer, independent of the scene behind it");
}

void RenderPart::declareStereo(ParameterSet& set) {
    set.boolean("stereo", false, "for red-green glasses: left eye's picture in green, right eye's in red")
        .real("eyes_metres", 0.065, 0, 10, "m", "distance between the eyes, if stereo");
}

Look RenderPart::lookOf(Primitive primitive) const {
    Look look;
    look.primitive = primitive;
    if (!isMesh(primitive)) {
        look.blending = values().choice("blend", blendings);
        look.clamped = values().boolean("clamped");
    }
    look.stereo = values().boolean("stereo");
    look.eyesMetres = static_cast<float>(values().real("eyes_metres"));
    return look;
}

}  // namespace dustbench::particles
