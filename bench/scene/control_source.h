// Source of the controls of each step: a drive file, a recording or a keyboard.
//
// Units: SI; controls as in vehicle_dynamics.h.
#pragma once

#include <memory>

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class ControlSource {
 public:
    virtual ~ControlSource() = default;
    /// Controls for the step that begins at `nowSeconds`; called once per step, in order. The preroll's steps begin
    /// before 0.
    [[nodiscard]] virtual Controls decide(const scene::VehicleParameters& parameters,
                                          const scene::VehicleState& vehicle, double nowSeconds) = 0;
    /// Speed of the vehicle at the start of the preroll.
    [[nodiscard]] virtual double initialSpeed() const { return 0; }
    /// Duration; infinite if it does not end.
    [[nodiscard]] virtual double seconds() const = 0;
    /// A copy that makes the same decisions from now on, used to drive ahead.
    [[nodiscard]] virtual std::unique_ptr<ControlSource> clone() const = 0;
};

}  // namespace dustbench::bench
