// The shadow that dust throws on the opaque scene where scene::Lights::onDust.
//
// A map across the sun's direction holds three sums for each column of dust: its optical depth Σ, and the mean and mean
// square of its height w towards the sun, weighted by depth. Between a point at w₀ and the sun lies
//
//     Σ·½·[1 − erf((w₀ − w̄)/√(2·var w))],
//
// which is exact for dust that is Gaussian along the column, and for points with all of it in front, as on the ground.
// Puffs narrower than half a texel are drawn that wide, with their mass.
//
// Units: metres; depth has none. Owns: the map, on CPU and GPU. Threads: the device's; uses the current oneTBB arena.
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

    /// `toSun` has a direction.
    DustShadow(gpu::Device& device, const glm::vec3& toSun);

    /// Takes this dust's shadow; the map covers all of it. Puffs with a number that is not finite throw none.
    void set(const Puffs& dust);

    /// From positions relative to `eye` (world axes) to texture coordinates, and w in metres.
    [[nodiscard]] glm::mat4 eyeToTexture(const glm::dvec3& eye) const;
    /// Σ, Σw, Σw².
    [[nodiscard]] const gpu::Texture& columns() const { return columns_; }

 private:
    glm::dmat3 axes_;                           ///< rows: two across the sun's direction, and towards it
    glm::dvec3 corner_{0}, metresPerTexel_{1};  ///< in these axes; of z: the middle, 1
    std::vector<float> values_;
    gpu::Texture columns_;
};

}  // namespace dustbench::draw
