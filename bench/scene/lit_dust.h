// Dust lit by the sun, if scene::Lights::onDust: each puff has the colour that its centre shows towards the eye.
//
// Units: metres; linear RGB. Owns: the colours. Threads: one at a time; uses the current oneTBB arena, bit-identical at
// any number of threads.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/choices.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"

namespace dustbench::bench {

/// The light on the dust.
enum class DustLight {
    none,  ///< none: its own colours everywhere
    sun,   ///< sun and sky: scene::dustLight
};
inline constexpr Choices<DustLight> dustLights{{"none", DustLight::none}, {"sun", DustLight::sun}};

class LitDust {
 public:
    /// The `dust` with new colours: its own times scene::dustLight() at each centre. Sunlight is attenuated by the
    /// closed form of all puffs, each with the share `opticalDepthShare` of its depth; the neglected depth is below
    /// 1e-3. Valid until the next call; `dust` must outlive it.
    [[nodiscard]] Puffs light(const Puffs& dust, const scene::Scene& scene, const glm::dvec3& eye,
                              double opticalDepthShare);

    [[nodiscard]] std::size_t bytes() const;

 private:
    std::vector<float> red_, green_, blue_;
};

}  // namespace dustbench::bench
