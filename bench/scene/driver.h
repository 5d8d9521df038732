// Follows a target speed with throttle and brake: feed-forward of what the vehicle needs, and PI control of the rest.
//
// Units: SI. Owns: the integral of the speed error.
#pragma once

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class Driver {
 public:
    /// Throttle and brake for the step from a moment with target `targetNow` to one with `targetNext`.
    /// `steer` is passed through. The integral rests while the pedals are at their stops (no wind-up).
    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& state,
                                  double targetNow, double targetNext, double steer, double dt);

 private:
    double integral_ = 0;  ///< m/s², added to the wanted acceleration
};

}  // namespace dustbench::bench
