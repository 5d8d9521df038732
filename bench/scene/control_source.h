// Who drives: for each step the pedals and the wheel, from a drive's file, a recording or a keyboard.
//
// Units: SI; controls as in vehicle_dynamics.h.
#pragma once

#include <memory>

#include "bench/scene/vehicle_dynamics.h"

namespace dustbench::bench {

class ControlSource {
 public:
    virtual ~ControlSource() = default;
    /// For the step that begins at `nowSeconds`; asked once a step, in order. The preroll's steps begin before 0.
    [[nodiscard]] virtual Controls decide(const scene::VehicleParameters& parameters,
                                          const scene::VehicleState& vehicle, double nowSeconds) = 0;
    /// With which the vehicle enters the preroll.
    [[nodiscard]] virtual double initialSpeed() const { return 0; }
    /// How long it has something to say; infinite where it never ends.
    [[nodiscard]] virtual double seconds() const = 0;
    /// A copy that decides alike from here on, to drive ahead with.
    [[nodiscard]] virtual std::unique_ptr<ControlSource> clone() const = 0;
};

}  // namespace dustbench::bench
