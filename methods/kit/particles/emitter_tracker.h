// Follows the vehicle's wheels from step to step, so that births can be spread along the way they went.
//
// Frame: world. Owns: where the wheels were.
#pragma once

#include <array>
#include <span>

#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class EmitterTracker {
 public:
    /// The wheels' ways through a step that ends in `state`; none without a vehicle. The first way is taken from the
    /// wheels' velocities.
    [[nodiscard]] std::span<const Emitter> follow(const scene::Scene& scene, const scene::SceneState& state,
                                                  double seconds);

 private:
    std::array<Emitter, 4> wheels_;
    bool known_ = false;  ///< wheels_ holds the end of the step before
};

}  // namespace dustbench::particles
