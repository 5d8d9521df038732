#include "methods/kit/light/lit_puffs.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::light {
namespace {

constexpr double toleratedDepth = 1e-3;
constexpr std::size_t puffsABlock = 64;

}  // namespace

SunDepth sunDepths(const Puffs& puffs, const scene::Scene& scene, double opticalDepthShare) {
    const double neglected = toleratedDepth / static_cast<double>(std::max<std::size_t>(puffs.size(), 1));
    return {puffs, glm::dvec3(scene.lights.toSun), opticalDepthShare, neglected};
}

Puffs LitPuffs::light(const Puffs& puffs, const SunDepth& depths, const scene::Scene& scene, const glm::dvec3& eye) {
    for (std::vector<float>* column : {&red_, &green_, &blue_}) column->resize(puffs.size());
    parallel::forEachBlock(puffs.size(), puffsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::dvec3 centre(puffs.position(i));
            const glm::dvec3 sight = centre - eye;
            const double metres = glm::length(sight);
            const double cosine = metres > 0 ? glm::dot(sight, glm::dvec3(scene.lights.toSun)) / metres : 1;
            const float transmittance = static_cast<float>(std::exp(-depths.at(centre)));
            const glm::vec3 shown =
                puffs.colour(i) * scene::dustLight(scene, transmittance, static_cast<float>(cosine));
            red_[i] = shown.r;
            green_[i] = shown.g;
            blue_[i] = shown.b;
        }
    });
    Puffs lit = puffs;
    lit.uniformColour = false;
    lit.red = red_;
    lit.green = green_;
    lit.blue = blue_;
    return lit;
}

std::size_t LitPuffs::bytes() const {
    return (red_.capacity() + green_.capacity() + blue_.capacity()) * sizeof(float);
}

}  // namespace dustbench::light
