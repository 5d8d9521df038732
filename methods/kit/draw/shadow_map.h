// Depth of a group of casters as the sun sees them: a square of parallel rays about a centre.
//
// Units: metres; depth is reversed: 1 next to the sun, 0 on the far side. Owns: its depth texture.
#pragma once

#include <glm/glm.hpp>
#include <string_view>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

class ShadowMap {
 public:
    /// Takes in casters within `radiusMetres` of the centre that `aim` names.
    ShadowMap(gpu::Device& device, std::string_view label, int texels, double radiusMetres, const glm::vec3& toSun);

    /// The centre moves in whole texels, so that the shadow's edge does not crawl as the casters move.
    void aim(const glm::dvec3& centre);
    /// Draws go here from now on; everything is lit again.
    void bindAndClear() const;

    /// From positions relative to `eye` (world axes) to the map's clip space.
    [[nodiscard]] glm::mat4 eyeToLight(const glm::dvec3& eye) const;
    /// The same to texture coordinates.
    [[nodiscard]] glm::mat4 eyeToTexture(const glm::dvec3& eye) const;

    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    [[nodiscard]] double texelMetres() const { return 2 * radius_ / depth_.width(); }

 private:
    double radius_;
    glm::dmat3 axes_;       ///< rows: right, up, towards the sun
    glm::dvec3 centre_{0};  ///< along these axes
    gpu::Texture depth_;
    gpu::Framebuffer target_;
};

}  // namespace dustbench::draw
