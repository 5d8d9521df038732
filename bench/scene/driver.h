// Follows a target speed with throttle and brake: feed-forward of the required acceleration plus PI control of the
// error.
//
// Units: SI. Owns: the integral of the speed error.
#pragma once

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class Driver {
 public:
    /// Throttle and brake for a step that starts at target `targetNow` and ends at `targetNext`. `steer` is passed
    /// through. The integral is frozen while the pedals are at their limits (anti-windup).
    [[nodiscard]] Controls decide(const scene::VehicleParameters& parameters, const scene::VehicleState& state,
                                  double targetNow, double targetNext, double steer, double dt);

 private:
    double integral_ = 0;  ///< m/s², added to the wanted acceleration
};

}  // namespace dustbench::bench
