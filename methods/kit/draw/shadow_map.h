// Maps of the shadows on the opaque scene, as seen from the sun: the depth of a group of solid casters, and the sums of
// the dust above the ground.
//
// Units: metres. Owns: the maps. Threads: the device's; that of dust uses the current oneTBB arena.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

/// Definitions for shaders that include opaque_shadow.glsl: which maps the scene has.
[[nodiscard]] std::map<std::string, std::string> shadowCasters(const scene::Scene& scene);

/// Depth map of a group of shadow casters: an orthographic square around a centre. Depth is reversed: 1 nearest to the
/// sun, 0 on the far side.
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

// --- The shadow that dust casts on the opaque scene if scene::Lights::onDust.
//
// A map across the sun's direction stores three sums for each column of dust: its optical depth Σ, and the mean and
// mean square of its height w towards the sun, weighted by depth. The depth between a point at w₀ and the sun is
//
//     Σ·½·[1 − erf((w₀ − w̄)/√(2·var w))],
//
// which is exact for dust that is Gaussian along the column, and for points behind all of it, as on the ground. Puffs
// narrower than half a texel are drawn that wide, with the same mass.

class DUSTBENCH_API DustShadow {
 public:
    static constexpr int texels = 256;  ///< along each edge of the map

    /// `toSun` must not be zero.
    DustShadow(gpu::Device& device, const glm::vec3& toSun);

    /// Computes the shadow of this dust; the map covers all of it. Puffs with non-finite values cast no shadow.
    void set(const Puffs& dust);

    /// From positions relative to `eye` (world axes) to texture coordinates, and w in metres.
    [[nodiscard]] glm::mat4 eyeToTexture(const glm::dvec3& eye) const;
    /// Σ, Σw, Σw².
    [[nodiscard]] const gpu::Texture& columns() const { return columns_; }

 private:
    glm::dmat3 axes_;                           ///< rows: two across the sun's direction, and towards it
    glm::dvec3 corner_{0}, metresPerTexel_{1};  ///< in these axes; z: the middle, 1
    std::vector<float> values_;
    gpu::Texture columns_;
};

}  // namespace dustbench::draw
