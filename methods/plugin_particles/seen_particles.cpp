#include "methods/plugin_particles/seen_particles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::plugin_particles {
namespace {

using particles::Look;
using particles::Primitive;

bool canBeLeftOut(const Look& look) {
    return look.primitive != Primitive::curves && look.primitive != Primitive::surface;
}

bool isDrawnInItsSize(const Look& look) {
    return look.primitive == Primitive::puff || look.primitive == Primitive::sprites ||
           look.primitive == Primitive::movingSprites || (look.primitive == Primitive::points && look.pixels == 0);
}

bool hasPath(const Look& look) {
    return look.primitive == Primitive::lines || look.primitive == Primitive::hybrid ||
           look.primitive == Primitive::movingSprites;
}

/// The sides of a view and a plane through the eye, seen from it.
class Frustum {
 public:
    /// `margin`: pixels that a primitive may extend beyond its size in the world.
    Frustum(const scene::View& view, float margin) : eye_(view.camera.eye) {
        const glm::mat3 toEye(view.worldToEye());
        const glm::mat4 projection = view.eyeToClip();
        const glm::vec2 scale(projection[0][0], projection[1][1]);
        const glm::vec2 image(view.width, view.height);
        pixelsAtOneMetre_ = scale.y * image.y / 2;
        // A point (x, y, −d) in eye space is inside if |x|·scale ≤ d·(1 + margin).
        const glm::vec2 wide = 1.0f + 2 * margin / image;
        std::size_t n = 0;
        for (const float side : {-1.0f, 1.0f}) {
            planes_[n++] = glm::normalize(glm::vec3(side * scale.x, 0, -wide.x)) * toEye;
            planes_[n++] = glm::normalize(glm::vec3(0, side * scale.y, -wide.y)) * toEye;
        }
        planes_[n] = glm::vec3(0, 0, -1) * toEye;
    }

    [[nodiscard]] glm::vec3 fromEye(const Puffs& p, std::size_t i) const { return {glm::dvec3(p.position(i)) - eye_}; }
    [[nodiscard]] bool touches(const glm::vec3& fromEye, float radius) const {
        // Rounding: a millionth of the distance.
        const float reach = radius + 1e-3f + 1e-6f * glm::length(fromEye);
        return std::ranges::all_of(planes_,
                                   [&](const glm::vec3& inwards) { return glm::dot(inwards, fromEye) >= -reach; });
    }
    [[nodiscard]] float pixelsOf(const glm::vec3& fromEye, float radius) const {
        return radius * pixelsAtOneMetre_ / std::max(glm::length(fromEye), 1e-6f);
    }

 private:
    glm::dvec3 eye_;
    std::array<glm::vec3, 5> planes_;  ///< unit normals, inwards; each plane contains the eye
    float pixelsAtOneMetre_;
};

/// Radius of a ball around the particle that contains all that is drawn of it.
float reachOf(const Puffs& p, std::size_t i, const Look& look, float stepSeconds, float radius) {
    constexpr float cornerRadii = 2.2f;  // of a square quad of half side 1.5 r
    float reach = cornerRadii * radius + look.eyesMetres / 2;
    if (hasPath(look)) {
        const float lasted = std::min(look.seconds > 0 ? look.seconds : stepSeconds, p.age[i]);
        reach += lasted * glm::length(glm::vec3(p.velocityX[i], p.velocityY[i], p.velocityZ[i]));
    }
    return reach;
}

float weighted(float opacity, float weight, bool additive) {
    return additive || weight == 1 ? weight * opacity : -std::expm1(weight * std::log1p(-opacity));
}

}  // namespace

Thinned thinned(std::uint64_t serial, float radiusPixels, float detailPixels) {
    if (!(radiusPixels < detailPixels)) return {};
    const float share = radiusPixels / detailPixels, f = share * share;
    if (!(f > 0)) return {0, 1};
    constexpr std::uint64_t goldenRatio = 0x9e3779b97f4a7c15;
    const float u = static_cast<float>(serial * goldenRatio >> 40) * 0x1p-24f;
    const float band = (1 - f) / 4, full = f / (1 - band / 2);
    const float weight = band > 0 ? std::clamp((full - u) / (full * band), 0.0f, 1.0f) : 1.0f;
    return {weight, 1 / share};
}

bool dependsOnView(const Look& look, const Sight& sight) {
    return canBeLeftOut(look) && (sight.culls || (sight.detailPixels > 0 && isDrawnInItsSize(look)));
}

Puffs SeenParticles::of(const Puffs& all, const scene::View& view, const Look& look, float stepSeconds,
                        const Sight& sight) {
    const bool thins = sight.detailPixels > 0 && isDrawnInItsSize(look);
    if (!dependsOnView(look, sight)) return all;
    const Frustum frustum(view, look.pixels / 2 + 2);
    const auto drawn = [&](std::size_t i, const glm::vec3& fromEye) {
        return thins ? thinned(all.serial[i], frustum.pixelsOf(fromEye, all.radius[i]), sight.detailPixels) : Thinned{};
    };
    seen_.prepare(all.size());
    parallel::forEachBlock(all.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        std::array<std::uint8_t, particles::chunkSize> flags;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = first + k;
            const glm::vec3 fromEye = frustum.fromEye(all, i);
            const Thinned as = drawn(i, fromEye);
            const float reach = reachOf(all, i, look, stepSeconds, as.growth * all.radius[i]);
            flags[k] = as.weight > 0 && (!sight.culls || frustum.touches(fromEye, reach)) ? 1 : 0;
        }
        seen_.note(first / particles::chunkSize, flags.data(), count);
    });
    const auto kept = seen_.collect();
    if (kept.size() == all.size() && !thins) return all;

    particles::ParticleStore& s = copies_;
    s.keepOneColour(all.uniformColour);
    s.colourOfAll = all.colourOfAll;
    s.resize(kept.size());
    const bool additive = look.blending == particles::Blending::additive;
    parallel::forEachBlock(kept.size(), particles::chunkSize, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            const std::size_t i = kept[k];
            s.serial[k] = all.serial[i];
            s.x[k] = all.x[i], s.y[k] = all.y[i], s.z[k] = all.z[i];
            s.velocityX[k] = all.velocityX[i], s.velocityY[k] = all.velocityY[i], s.velocityZ[k] = all.velocityZ[i];
            s.age[k] = all.age[i], s.lifetime[k] = all.lifetime[i];
            const Thinned as = drawn(i, frustum.fromEye(all, i));
            s.radius[k] = as.growth * all.radius[i];
            s.opacity[k] = weighted(all.opacity[i], as.weight, additive);
            if (!all.uniformColour) s.red[k] = all.red[i], s.green[k] = all.green[i], s.blue[k] = all.blue[i];
        }
    });
    return s;
}

}  // namespace dustbench::plugin_particles
