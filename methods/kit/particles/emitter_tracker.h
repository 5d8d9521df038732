// Tracks the vehicle's wheels between steps, so that births can be spread along their paths.
//
// Frame: world. Owns: the wheels' last positions.
#pragma once

#include <array>
#include <span>

#include "methods/kit/particles/step.h"

namespace dustbench::particles {

class DUSTBENCH_API EmitterTracker {
 public:
    /// The wheels' paths through a step that ends in `state`; empty without a vehicle. The first path is extrapolated
    /// from the wheels' velocities.
    [[nodiscard]] std::span<const Emitter> follow(const scene::Scene& scene, const scene::SceneState& state,
                                                  double seconds);

 private:
    std::array<Emitter, 4> wheels_;
    bool known_ = false;  ///< wheels_ is the end of the previous step
};

}  // namespace dustbench::particles
