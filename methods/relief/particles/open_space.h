// One step of the fixed law for particles between the face and the highest point of the surface, which cannot hit
// anything: most particles, and the cheapest. Position with age, and velocity, are four lanes each; the results equal
// those of `moved` (relief_motion.h).
//
// Units: m, m/s; ages in steps. Frame: the panel's. Threads: pure.
#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>

#include "methods/kit/lanes/lanes.h"
#include "methods/relief/particles/relief_particles.h"

namespace dustbench::relief {

class OpenSpace {
 public:
    /// `within`: slightly less than half the plate's size; `deepest`: the z above which there is no surface.
    OpenSpace(const StepSettings& settings, const glm::vec2& within, float deepest)
        : stepSeconds_(settings.stepSeconds),
          fall_(lanesOf(settings.gravity * (0.5f * settings.stepSeconds * settings.stepSeconds), 1)),
          pull_(lanesOf(settings.gravity * settings.stepSeconds, 0)),
          low_{-within.x, -within.y, deepest, -endless},
          high_{within.x, within.y, 0, settings.maximumAgeSteps},
          lowBefore_{-endless, -endless, deepest, -endless} {}

    /// Returns false and changes nothing if the particle may leave this space or reaches its maximum age.
    [[gnu::always_inline]] bool step(glm::vec4& place, glm::vec4& velocity) const {
        Float4 from, speed;
        std::memcpy(&from, &place, sizeof from);
        std::memcpy(&speed, &velocity, sizeof speed);
        const Float4 to = from + speed * stepSeconds_ + fall_;
        if (!everyLane((to > low_) & (to < high_) & (from > lowBefore_))) return false;
        speed += pull_;
        std::memcpy(&place, &to, sizeof to);
        std::memcpy(&velocity, &speed, sizeof speed);
        return true;
    }

 private:
    using Float4 = lanes::Float4;
    static constexpr float endless = std::numeric_limits<float>::infinity();

    static Float4 lanesOf(const glm::vec3& v, float w) { return Float4{v.x, v.y, v.z, w}; }
    static bool everyLane(const lanes::Int4& mask) {
        std::uint64_t halves[2];
        std::memcpy(halves, &mask, sizeof mask);
        return (halves[0] & halves[1]) == ~std::uint64_t{0};
    }

    float stepSeconds_;
    Float4 fall_, pull_, low_, high_, lowBefore_;
};

}  // namespace dustbench::relief
