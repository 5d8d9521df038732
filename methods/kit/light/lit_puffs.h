// Puffs lit by the sun, if scene::Lights::onDust: each has the colour that its centre shows towards the eye.
//
// Units: metres; linear RGB. Owns: the colours. Threads: one at a time; uses the current oneTBB arena, bit-identical at
// any number of threads.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/scene.h"
#include "methods/contract/volume.h"
#include "methods/kit/light/sun_depth.h"

namespace dustbench::light {

/// The depths towards the scene's sun within these puffs, each with the share `opticalDepthShare` of its depth. At any
/// point, the neglected depth is below 1e-3.
[[nodiscard]] DUSTBENCH_API SunDepth sunDepths(const Puffs& puffs, const scene::Scene& scene, double opticalDepthShare);

class DUSTBENCH_API LitPuffs {
 public:
    /// The `puffs` with new colours: their own times scene::dustLight() at each centre, with sunlight that has passed
    /// `depths`. Valid until the next call; `puffs` must outlive it.
    [[nodiscard]] Puffs light(const Puffs& puffs, const SunDepth& depths, const scene::Scene& scene,
                              const glm::dvec3& eye);

    [[nodiscard]] std::size_t bytes() const;

 private:
    std::vector<float> red_, green_, blue_;
};

}  // namespace dustbench::light
