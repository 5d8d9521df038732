// Sprites blurred along the path of the last step. Together the copies have the light and optical depth of one sprite.
#include "methods/kit/particles/part_parameters.h"
#include "methods/kit/particles/render_part.h"

namespace dustbench::particles::parts::render::aa_sprites {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::movingSprites;

    static void declare(ParameterSet& set) {
        declarePicture(set);
        set.choice("by", AntiAliasing::copies, antiAliasings,
                   "copies of each sprite between its old and new position, or the mean of whole pictures")
            .integer("copies", 4, 1, 64, "", "number of copies or of pictures")
            .real("seconds", 0, 0, 10, "s", "duration of the path that they show; 0: the last step")
            .boolean("fade", true, "gives newer ones more weight");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.picture = pictureOf(values);
        look.by = values.choice("by", antiAliasings);
        look.copies = static_cast<int>(values.integer("copies"));
        look.seconds = static_cast<float>(values.real("seconds"));
        look.fading = values.boolean("fade");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("sprites, anti-aliased in time", "Thesis, 4.1.6", Blending::additive);
}

}  // namespace dustbench::particles::parts::render::aa_sprites
