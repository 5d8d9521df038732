// The shadow that dust casts on the opaque scene if scene::Lights::onDust.
//
// A map across the sun's direction stores three sums for each column of dust: its optical depth Σ, and the mean and
// mean square of its height w towards the sun, weighted by depth. The depth between a point at w₀ and the sun is
//
//     Σ·½·[1 − erf((w₀ − w̄)/√(2·var w))],
//
// which is exact for dust that is Gaussian along the column, and for points behind all of it, as on the ground. Puffs
// narrower than half a texel are drawn that wide, with the same mass.
//
// Units: metres; depth is dimensionless. Owns: the map, on CPU and GPU. Threads: the device's; uses the current oneTBB
// arena.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

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
