#include "methods/kit/draw/shadow_map.h"

#include <algorithm>
#include <cmath>

#include "methods/kit/light/sun_depth.h"

namespace dustbench::draw {

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

}  // namespace dustbench::draw
