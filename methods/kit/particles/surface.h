// Surfaces that particles may hit during a step, and the response to a contact.
//
// Units: m, m/s, s. Frame: world. Threads: const members are safe from any.
// Source: Thesis, 5.3.2 and 6.1. Departs: the path from the old to the new position is tested as a segment, so that no
// speed is too high; the thesis tests positions.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "methods/kit/particles/step.h"

namespace dustbench::particles {

/// The straight paths of `count` particles, which end together: at the end of the step, or of a part of it.
struct Ways {
    std::size_t count;
    const float *fromX, *fromY, *fromZ;
    const float *toX, *toY, *toZ;
    const float* seconds;   ///< duration of each
    float leftSeconds = 0;  ///< from the end of all paths to the end of the step

    [[nodiscard]] glm::vec3 from(std::size_t i) const { return {fromX[i], fromY[i], fromZ[i]}; }
    [[nodiscard]] glm::vec3 to(std::size_t i) const { return {toX[i], toY[i], toZ[i]}; }
};

/// The velocity after a contact: v ← (1 − friction)·v∥ − restitution·v⊥.
struct Contact {
    float restitution = 1;
    float friction = 0;
    bool kills = false;      ///< the particle dies
    float delaySeconds = 0;  ///< from the contact to that death, which becomes the end of its lifetime
};

/// One path, and its share at which it hits a surface.
struct Meeting {
    glm::vec3 from, to;
    float seconds;
    float share;
    float leftSeconds = 0;  ///< from the end of the path to the end of the step

    [[nodiscard]] glm::vec3 point() const { return from + share * (to - from); }
};

/// Where a particle touches a surface.
struct Touch {
    glm::vec3 point;
    glm::vec3 normal;       ///< unit, towards the side that the particle comes from
    glm::vec3 velocity{0};  ///< of the surface at the point
};

class Surface {
 public:
    /// Share of a path without contact.
    static constexpr float none = 2;

    virtual ~Surface() = default;

    /// Called once per step, before all paths.
    virtual void begin(const Step&) {}
    /// Writes the share of each path, 0..1, at which it first hits the surface, or `none`.
    virtual void meet(const Ways& ways, float* share) const = 0;
    /// The contact of a path at the share that `meet` returned for it.
    [[nodiscard]] virtual Touch touchAt(const Meeting& meeting) const = 0;
    /// Largest coordinate that enters the test, as a bound on its rounding error.
    [[nodiscard]] virtual float extentMetres() const = 0;
    [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

/// |x| + |y| + |z|: the contribution of a position to an extent.
[[nodiscard]] inline float sumOfSizes(const glm::vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}  // namespace dustbench::particles
