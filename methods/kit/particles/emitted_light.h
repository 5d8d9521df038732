// Approximates the light that particles emit by a few point lights: fire lights its surroundings.
//
//     colour = k·Σ C·α·size³
//     position = Σ x·L / Σ L,   L = (R + G + B)·α·size³
//
// The particles are divided by age into groups with one light each. If the wind bends a fire, the young particles light
// from its base and the old ones from its tip.
//
// Units: m; colours linear RGB in m², the intensity that scene::PointLight takes. Frame: world. Threads: pure; sums are
// in storage order, in double precision. Source: Thesis, 6.3.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/volume.h"

namespace dustbench::particles {

struct EmittedLight {
    glm::vec3 colour{0};
    glm::vec3 position{0};  ///< unspecified if the colour is 0
};

/// Returns `parts` lights, the youngest particles first. A particle belongs to light floor(parts·age/lifetime); the
/// last light includes age = lifetime. `perMetre`: the thesis's constant k. Throws std::invalid_argument if
/// `parts` is below one.
[[nodiscard]] DUSTBENCH_API std::vector<EmittedLight> emittedLights(const Puffs& puffs, int parts, float perMetre);

}  // namespace dustbench::particles
