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

    /// m/s², what the integral adds to the wanted acceleration.
    [[nodiscard]] double integral() const { return integral_; }

 private:
    double integral_ = 0;
};

}  // namespace dustbench::bench
