// The frame of a solid that moves during a step, and paths relative to it.
//
// The frame moves linearly from its pose at the step's start to that at its end, M(t) = (1 − t)·M0 + t·M1, so that each
// point of the solid has one velocity for the whole step, (M1·p − M0·p)/Δt. A path that ends outside of a solid in one
// step starts at the same position in the next, bit for bit.
//
// Units: m, m/s, s. Frame: world, unless named local. Threads: const members are safe from any.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace dustbench::particles {

class CarriedFrame {
 public:
    /// Sets the pose at a step's end. The first call extrapolates the pose at the start backwards with
    /// `velocity`.
    void moveTo(const glm::dmat4& toWorld, const glm::dvec3& velocity, double stepSeconds);

    /// `seconds`: time before the step's end.
    [[nodiscard]] glm::vec3 toLocal(const glm::vec3& point, float seconds) const;
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& local, float seconds) const;
    /// Rotates only.
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
