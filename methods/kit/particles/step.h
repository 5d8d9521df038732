// One step in time as the parts see it: the world, its wheels, and how long the step is.
//
// Units: m, m/s, s. Frame: world. Owns: nothing; it lives as long as one update.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/scene.h"

namespace dustbench::particles {

/// Where particles may be born: a point that moved along a line during the step, and its axes.
struct Emitter {
    glm::vec3 from{0}, to{0};                  ///< at the step's begin and end
    glm::vec3 velocityFrom{0}, velocityTo{0};  ///< of what carries it
    glm::vec3 forward{1, 0, 0}, up{0, 1, 0}, right{0, 0, 1};
    float speed = 0;  ///< along `forward`, m/s
};

struct Step {
    const scene::Scene& scene;
    const scene::SceneState& state;
    double seconds;
    std::uint64_t seed;
    double fixedRatePerSecond;          ///< above 0: births per second, whatever the emission says
    std::span<const Emitter> wheels;    ///< empty without a vehicle
    std::int64_t particlesPerPuff = 1;  ///< how many times as many births the emission gives, at any rate
};

/// Every use of random numbers has a stream of its own, so that swapping one part leaves the others' numbers alone.
enum RandomStream : std::uint32_t {
    positionStream = 1,
    velocityStream,
    lifeStream,
    sizeStream,
    colourStream,
    windStream
};

}  // namespace dustbench::particles
