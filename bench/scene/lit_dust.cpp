#include "bench/scene/lit_dust.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/light/sun_depth.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::bench {
namespace {

constexpr double toleratedDepth = 1e-3;
constexpr std::size_t puffsABlock = 64;

}  // namespace

Puffs LitDust::light(const Puffs& dust, const scene::Scene& scene, const glm::dvec3& eye, double opticalDepthShare) {
    for (std::vector<float>* column : {&red_, &green_, &blue_}) column->resize(dust.size());
    const double neglected = toleratedDepth / static_cast<double>(std::max<std::size_t>(dust.size(), 1));
    const light::SunDepth depths(dust, glm::dvec3(scene.lights.toSun), opticalDepthShare, neglected);
    parallel::forEachBlock(dust.size(), puffsABlock, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            const glm::dvec3 centre(dust.position(i));
            const glm::dvec3 sight = centre - eye;
            const double metres = glm::length(sight);
            const double cosine = metres > 0 ? glm::dot(sight, glm::dvec3(scene.lights.toSun)) / metres : 1;
            const float transmittance = static_cast<float>(std::exp(-depths.at(centre)));
            const glm::vec3 shown = dust.colour(i) * scene::dustLight(scene, transmittance, static_cast<float>(cosine));
            red_[i] = shown.r;
            green_[i] = shown.g;
            blue_[i] = shown.b;
        }
    });
    Puffs lit = dust;
    lit.uniformColour = false;
    lit.red = red_;
    lit.green = green_;
    lit.blue = blue_;
    return lit;
}

std::size_t LitDust::bytes() const {
    return (red_.capacity() + green_.capacity() + blue_.capacity()) * sizeof(float);
}

}  // namespace dustbench::bench
