// The light that particles give off, as a few lights at a point: fire lights what stands around it.
//
//     colour = k·Σ C·α·size³
//     position = Σ x·L / Σ L,   L = (R + G + B)·α·size³
//
// One light for each part of the particles, divided by age: of a fire that the wind bends, the young particles light
// from its base and the old ones from its tip.
//
// Units: m; colours linear RGB, without limit. Frame: world. Threads: pure; sums are in storage order, in double
// precision. Source: Thesis, 6.3.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/volume.h"

namespace dustbench::particles {

struct EmittedLight {
    glm::vec3 colour{0};
    glm::vec3 position{0};  ///< unspecified where the colour is 0
};

/// `parts` lights, the youngest particles first: part floor(parts·age/lifetime), the last one includes age = lifetime.
/// `perCubicMetre`: the thesis's constant k. Throws std::invalid_argument for fewer than one part.
[[nodiscard]] DUSTBENCH_API std::vector<EmittedLight> emittedLights(const Puffs& puffs, int parts, float perCubicMetre);

}  // namespace dustbench::particles
