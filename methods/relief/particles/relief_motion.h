// The motion of a particle within a relief during one step.
//
// paper:  P ← P₀ + V₀·T + ½·g·T²,  V ← V₀·T + g·T,  T the age in steps times Δt; V₀ per step
// fixed:  P ← P₀ + V₀·Δt + ½·g·Δt²,  V ← V₀ + g·Δt
//
// In the paper T is the age, which increases by one per step, and P₀ and V₀ are rewritten in each step. With one step
// as the unit of time the first step is right; afterwards displacement and velocity compound. In SI units, with n the
// age in steps: P ← P₀ + V₀·nΔt + ½·g·(nΔt)² and V ← n·(V₀ + g·Δt).
//
// Units: m, m/s, s. Frame: the panel's. Threads: pure. Source: Bergeron, 3.2.
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/choices.h"

namespace dustbench::relief {

enum class MotionLaw { paper, fixed };
inline constexpr Choices<MotionLaw> motionLaws{{"paper", MotionLaw::paper}, {"fixed", MotionLaw::fixed}};

struct Motion {
    glm::vec3 place, velocity;
};

/// `ageSteps` includes the current step: 1 in a particle's first step.
[[nodiscard]] inline Motion moved(MotionLaw law, const Motion& old, const glm::vec3& gravity, float ageSteps,
                                  float stepSeconds) {
    if (law == MotionLaw::fixed)
        return {old.place + old.velocity * stepSeconds + gravity * (0.5f * stepSeconds * stepSeconds),
                old.velocity + gravity * stepSeconds};
    const float t = ageSteps * stepSeconds;
    return {old.place + old.velocity * t + gravity * (0.5f * t * t), (old.velocity + gravity * stepSeconds) * ageSteps};
}

}  // namespace dustbench::relief
