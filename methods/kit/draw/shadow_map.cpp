#include "methods/kit/draw/shadow_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "methods/kit/light/sun_depth.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::draw {
namespace {

constexpr double reachDeviations = 4;
constexpr std::size_t rowsABlock = 8;
constexpr std::size_t channels = 4;  ///< the fourth is not used

bool isPlaced(const Puffs& dust, std::size_t i) {
    return std::isfinite(dust.x[i] + dust.y[i] + dust.z[i] + dust.radius[i]);
}

/// A puff in texels across the sun's direction, and in metres towards it.
struct Splat {
    glm::dvec2 centre, deviation;
    float depth, height, meanSquare;

    [[nodiscard]] int first(int axis) const {
        return std::max(static_cast<int>(std::ceil(centre[axis] - reachDeviations * deviation[axis])), 0);
    }
    [[nodiscard]] int last(int axis) const {
        return std::min(static_cast<int>(std::floor(centre[axis] + reachDeviations * deviation[axis])),
                        DustShadow::texels - 1);
    }
    [[nodiscard]] float profile(int axis, int texel) const {
        const double away = (static_cast<double>(texel) - centre[axis]) / deviation[axis];
        return static_cast<float>(std::exp(-away * away / 2));
    }
};

}  // namespace

std::map<std::string, std::string> shadowCasters(const scene::Scene& scene) {
    std::map<std::string, std::string> result;
    const bool panels = std::ranges::any_of(
        scene.panels, [](const scene::Panel& panel) { return panel.parent == scene::Panel::Parent::world; });
    if (scene.vehicle) result.emplace("VEHICLE", "1");
    if (panels || !scene.solids.empty()) result.emplace("SOLIDS", "1");
    return result;
}

ShadowMap::ShadowMap(gpu::Device& device, std::string_view label, int texels, double radiusMetres,
                     const glm::vec3& toSun)
    // A margin of texels stays empty, so that everything beyond the edge is lit, where sampling clamps to the last
    // texel.
    : radius_(radiusMetres * texels / (texels - 8)),
      axes_(glm::transpose(light::sunFrame(glm::dvec3(toSun)))),
      depth_(gpu::Texture::make2D(device, label, gpu::Format::depth32F, texels, texels, gpu::Filter::linear)),
      target_(device, label, nullptr, &depth_) {
    depth_.setDepthComparison();
}

void ShadowMap::aim(const glm::dvec3& centre) {
    centre_ = glm::floor(axes_ * centre / texelMetres() + 0.5) * texelMetres();
}

void ShadowMap::bindAndClear() const {
    target_.bind();
    target_.clearDepth();
}

glm::mat4 ShadowMap::eyeToLight(const glm::dvec3& eye) const {
    // x, y: (A(p + e) − c)/R in −1..1; depth ½ + ½(A(p + e) − c)/R in 0..1.
    const glm::dvec3 offset = (axes_ * eye - centre_) / radius_;
    glm::dmat4 matrix(axes_ / radius_);
    matrix[3] = glm::dvec4(offset, 1);
    for (int column = 0; column < 4; ++column) matrix[column][2] = 0.5 * (matrix[column][2] + matrix[column][3]);
    return glm::mat4(matrix);
}

glm::mat4 ShadowMap::eyeToTexture(const glm::dvec3& eye) const {
    glm::mat4 matrix = eyeToLight(eye);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 2; ++row) matrix[column][row] = 0.5f * (matrix[column][row] + matrix[column][3]);
    return matrix;
}

DustShadow::DustShadow(gpu::Device& device, const glm::vec3& toSun)
    : axes_(glm::transpose(light::sunFrame(glm::dvec3(toSun)))),
      values_(std::size_t{texels} * texels * channels),
      columns_(gpu::Texture::make2D(device, "dust shadow", gpu::Format::rgba32F, texels, texels, gpu::Filter::linear)) {
}

void DustShadow::set(const Puffs& dust) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (std::size_t i = 0; i < dust.size(); ++i) {
        if (!isPlaced(dust, i)) continue;
        const glm::dvec3 centre = axes_ * glm::dvec3(dust.position(i));
        const double reach = reachDeviations * maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        low = glm::min(low, centre - reach);
        high = glm::max(high, centre + reach);
    }
    std::ranges::fill(values_, 0.0f);
    if (!(low.x <= high.x)) {
        columns_.write(std::span<const float>(values_));
        return;
    }
    // Two texels on each side stay empty, because sampling beyond the edge repeats the last texel.
    metresPerTexel_ = glm::dvec3(glm::max(glm::dvec2(high - low) / (texels - 5.0), 1e-3), 1);
    corner_ = glm::dvec3(glm::dvec2(low) - 2.0 * glm::dvec2(metresPerTexel_), (low.z + high.z) / 2);

    std::vector<Splat> splats;
    for (std::size_t i = 0; i < dust.size(); ++i) {
        const double s = maths::puffDeviationMetres(static_cast<double>(dust.radius[i]));
        const double depth = maths::puffOpticalDepth(static_cast<double>(dust.opacity[i]));
        if (!(s > 0) || !(depth > 0) || !isPlaced(dust, i)) continue;
        const glm::dvec3 place = (axes_ * glm::dvec3(dust.position(i)) - corner_) / metresPerTexel_;
        const glm::dvec2 own(s / metresPerTexel_.x, s / metresPerTexel_.y), wide = glm::max(own, 0.5);
        splats.push_back({glm::dvec2(place), wide, static_cast<float>(depth * own.x * own.y / (wide.x * wide.y)),
                          static_cast<float>(place.z), static_cast<float>(place.z * place.z + s * s)});
    }
    parallel::forEachBlock(std::size_t{texels}, rowsABlock, [&](std::size_t firstRow, std::size_t rows) {
        std::array<float, texels> across;
        for (const Splat& splat : splats) {
            const int first = std::max(splat.first(1), static_cast<int>(firstRow));
            const int last = std::min(splat.last(1), static_cast<int>(firstRow + rows) - 1);
            if (first > last) continue;
            const int left = splat.first(0), right = splat.last(0);
            for (int x = left; x <= right; ++x) across[static_cast<std::size_t>(x)] = splat.profile(0, x);
            for (int y = first; y <= last; ++y) {
                const float share = splat.depth * splat.profile(1, y);
                float* const row = values_.data() + static_cast<std::size_t>(y) * texels * channels;
                for (int x = left; x <= right; ++x) {
                    const float depth = share * across[static_cast<std::size_t>(x)];
                    float* const texel = row + static_cast<std::size_t>(x) * channels;
                    texel[0] += depth;
                    texel[1] += depth * splat.height;
                    texel[2] += depth * splat.meanSquare;
                }
            }
        }
    });
    columns_.write(std::span<const float>(values_));
}

glm::mat4 DustShadow::eyeToTexture(const glm::dvec3& eye) const {
    // The centre of texel k is at k metresPerTexel from the corner, and at (k + ½)/texels in the texture.
    const glm::dvec3 scale = glm::dvec3(1.0 / texels, 1.0 / texels, 1) / metresPerTexel_;
    const glm::dvec3 offset = (axes_ * eye - corner_) * scale + glm::dvec3(0.5 / texels, 0.5 / texels, 0);
    glm::dmat4 matrix(1);
    for (int column = 0; column < 3; ++column) matrix[column] = glm::dvec4(axes_[column] * scale, 0);
    matrix[3] = glm::dvec4(offset, 1);
    return glm::mat4(matrix);
}

}  // namespace dustbench::draw
