// Dust as the sun lights it where scene::Lights::onDust: each puff has the colour that its centre shows towards the
// eye.
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

/// What lights the dust.
enum class DustLight {
    none,  ///< nothing: it has its colours wherever it is
    sun,   ///< sun and sky: scene::dustLight
};
inline constexpr Choices<DustLight> dustLights{{"none", DustLight::none}, {"sun", DustLight::sun}};

class LitDust {
 public:
    /// The `dust` with colours of its own: those that it has times scene::dustLight() at each centre. The sun's light
    /// is attenuated by the closed form of all puffs, each with the share `opticalDepthShare` of its depth; what it
    /// leaves out of the depth is below 1e-3. Valid until the next call; `dust` must outlive it.
    [[nodiscard]] Puffs light(const Puffs& dust, const scene::Scene& scene, const glm::dvec3& eye,
                              double opticalDepthShare);

    [[nodiscard]] std::size_t bytes() const;

 private:
    std::vector<float> red_, green_, blue_;
};

}  // namespace dustbench::bench
