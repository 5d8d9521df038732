#include "methods/plugin_particles/sunlight.h"

namespace dustbench::plugin_particles {

bool scattersLight(const particles::Look& look) {
    return look.blending == particles::Blending::alpha && !particles::isMesh(look.primitive);
}

bool castsShadow(const particles::Look& look) {
    using particles::Primitive;
    const bool hasSize = look.primitive == Primitive::puff || look.primitive == Primitive::sprites ||
                         look.primitive == Primitive::movingSprites;
    return hasSize && scattersLight(look);
}

void Sunlight::shine(std::span<const Puffs> casting) {
    joined_.resize(0);
    if (casting.size() == 1) {
        casting_ = casting.front();
    } else {
        for (const Puffs& puffs : casting) joined_.append(puffs);
        casting_ = joined_;
    }
    depths_ = light::sunDepths(casting_, scene_, 1);
}

Puffs Sunlight::on(const Puffs& puffs, const glm::dvec3& eye, light::LitPuffs& colours) const {
    return depths_ ? colours.light(puffs, *depths_, scene_, eye) : puffs;
}

}  // namespace dustbench::plugin_particles
