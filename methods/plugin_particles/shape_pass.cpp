#include "methods/plugin_particles/shape_pass.h"

namespace dustbench::plugin_particles {

std::unique_ptr<ShapePass> makePass(gpu::Device& device, const particles::Look& look, const scene::Lights& lights) {
    switch (look.primitive) {
        case particles::Primitive::points:
            return makePointPass(device, look);
        case particles::Primitive::lines:
            return makeLinePass(device, look);
        case particles::Primitive::curves:
            return makeCurvePass(device, look);
        case particles::Primitive::hybrid:
            return makeHybridPass(device, look);
        case particles::Primitive::objects:
            return makeObjectPass(device, look, lights);
        case particles::Primitive::surface:
            return makeSurfacePass(device, look, lights);
        case particles::Primitive::puff:
        case particles::Primitive::sprites:
        case particles::Primitive::movingSprites:
            break;
    }
    return makeSpritePass(device, look);
}

}  // namespace dustbench::plugin_particles
