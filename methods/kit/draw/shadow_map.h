// Depth map of a group of shadow casters as seen from the sun: an orthographic square around a centre.
//
// Units: metres; depth is reversed: 1 nearest to the sun, 0 on the far side. Owns: its depth texture.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>

#include "methods/contract/scene.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

/// Definitions for shaders that include opaque_shadow.glsl: which maps the scene has.
[[nodiscard]] std::map<std::string, std::string> shadowCasters(const scene::Scene& scene);

class DUSTBENCH_API ShadowMap {
 public:
    /// Covers casters within `radiusMetres` of the centre passed to `aim`.
    ShadowMap(gpu::Device& device, std::string_view label, int texels, double radiusMetres, const glm::vec3& toSun);

    /// Moves the centre in whole texels, so that shadow edges do not crawl as the casters move.
    void aim(const glm::dvec3& centre);
    /// Binds the map as the target of subsequent draws and clears it to fully lit.
    void bindAndClear() const;

    /// From positions relative to `eye` (world axes) to the map's clip space.
    [[nodiscard]] glm::mat4 eyeToLight(const glm::dvec3& eye) const;
    /// From the same positions to texture coordinates.
    [[nodiscard]] glm::mat4 eyeToTexture(const glm::dvec3& eye) const;

    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    [[nodiscard]] double texelMetres() const { return 2 * radius_ / depth_.width(); }

 private:
    double radius_;
    glm::dmat3 axes_;       ///< rows: right, up, towards the sun
    glm::dvec3 centre_{0};  ///< in these axes
    gpu::Texture depth_;
    gpu::Framebuffer target_;
};

}  // namespace dustbench::draw
