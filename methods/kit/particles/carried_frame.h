// The frame of a solid that moves through a step, and ways as seen from it.
//
// The frame goes on a straight line from its pose at the step's begin to that at its end, M(t) = (1 − t)·M0 + t·M1, so
// that each point of the solid has one velocity for the whole step, (M1·p − M0·p)/Δt. A way that ends outside a solid
// in one step begins there in the next, bit for bit.
//
// Units: m, m/s, s. Frame: world, unless it says local. Threads: const members are safe from any.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace dustbench::particles {

class CarriedFrame {
 public:
    /// Moves on to the pose at a step's end. The first time, the pose at the begin is that at the end less the way that
    /// `velocity` goes.
    void moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds);

    /// `seconds`: how long before the step's end.
    [[nodiscard]] glm::vec3 toLocal(const glm::vec3& point, float seconds) const;
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& local, float seconds) const;
    /// Rotates alone.
    [[nodiscard]] glm::vec3 directionToWorld(const glm::vec3& local, float seconds) const;
    [[nodiscard]] glm::vec3 velocityOf(const glm::vec3& local) const;

    [[nodiscard]] const glm::dmat4& atBegin() const { return begin_; }
    [[nodiscard]] const glm::dmat4& atEnd() const { return *end_; }

 private:
    [[nodiscard]] glm::dmat4 before(float seconds) const;

    glm::dmat4 begin_{1};
    std::optional<glm::dmat4> end_;
    glm::dmat4 fromBegin_{1}, fromEnd_{1};  ///< inverses
    double stepSeconds_ = 1;
};

}  // namespace dustbench::particles
