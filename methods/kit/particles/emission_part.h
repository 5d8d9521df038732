// The kind of part that determines how many particles are born in a step, and when.
//
// Source: Thesis, 3.1.3 and 4.6.
#pragma once

#include <cstdint>

#include "methods/kit/particles/part.h"
#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// Birth k of a step happens at firstSeconds + k·spacingSeconds after the step begins.
struct Births {
    std::int64_t count = 0;
    double firstSeconds = 0;
    double spacingSeconds = 0;
};

class EmissionPart : public Part {
 public:
    using Part::Part;
    [[nodiscard]] PartKind kind() const final { return PartKind::emission; }

    /// Called once per step; `step.particlesPerPuff` multiplies every rate. May keep state for the next step (an
    /// accumulator, a time counter).
    [[nodiscard]] virtual Births births(const Step& step) = 0;
    /// Without a vehicle, at the emission's own rate. Used to estimate the memory needed.
    [[nodiscard]] virtual double meanRatePerSecond() const { return 0; }
    /// True if the emission's own rate is 0 at any speed.
    [[nodiscard]] virtual bool neverEmits() const { return false; }
};

}  // namespace dustbench::particles
