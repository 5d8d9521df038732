// Random points and directions from uniform numbers: the disc, the cone, the sphere.
//
// Units: metres, turns and cosines as named. Threads: pure.
// Source: Thesis, 4.2.4 (disc), 4.3.1 (random direction), 4.3.2 (cone). Departs: see each.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "methods/kit/maths/sine.h"

namespace dustbench::maths {

/// `paper`: the formula as printed. `fixed`: a formula with the distribution that the text claims.
enum class SamplingMode { paper, fixed };

/// Uniform on the unit disc: r = √u, angle = v. Departs: no rejection, so that every point needs exactly two numbers.
[[nodiscard]] inline glm::vec2 discPoint(float u, float v) {
    const float r = std::sqrt(u);
    return {r * cosineOfTurns(v), r * sineOfTurns(v)};
}

/// Two unit vectors that form a right-handed frame (first, second, axis) with the unit vector `axis`.
struct Tangents {
    glm::vec3 first, second;
};
/// Source: Duff2017, listing 3.
[[nodiscard]] inline Tangents tangentsOf(glm::vec3 axis) {
    const float sign = std::copysign(1.0f, axis.z);
    const float a = -1.0f / (sign + axis.z);
    const float b = axis.x * axis.y * a;
    return {{1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x}, {b, sign + axis.y * axis.y * a, -axis.y}};
}

/// Directions within a half angle βmax of an axis.
/// paper: β = √u·βmax, which the paper calls uniform; true only for small cones (claim R20).
/// fixed: cos β = 1 − u·(1 − cos βmax), uniform on the cap by Archimedes.
class Cone {
 public:
    /// `axis`: a unit vector.
    Cone(SamplingMode mode, glm::vec3 axis, float halfAngleTurns)
        : mode_(mode), halfAngleTurns_(halfAngleTurns), axis_(axis), frame_(tangentsOf(axis)) {
        const float half = sineOfTurns(halfAngleTurns / 2);
        depth_ = 2.0f * half * half;
    }

    [[nodiscard]] glm::vec3 direction(float u, float v) const {
        float cosine, sine;
        if (mode_ == SamplingMode::paper) {
            const float angle = std::sqrt(u) * halfAngleTurns_;
            cosine = cosineOfTurns(angle);
            sine = sineOfTurns(angle);
        } else {
            const float depth = u * depth_;
            cosine = 1.0f - depth;
            sine = std::sqrt(depth * (2.0f - depth));
        }
        return sine * cosineOfTurns(v) * frame_.first + sine * sineOfTurns(v) * frame_.second + cosine * axis_;
    }

 private:
    SamplingMode mode_;
    float halfAngleTurns_;
    float depth_;  ///< 1 − cos βmax, without cancellation
    glm::vec3 axis_;
    Tangents frame_;
};

/// Uniform on the unit sphere: z = 1 − 2u, angle = v (Archimedes). Departs from the normalised cube vector of the
/// thesis, whose density is 5.2 times higher towards the corners than towards the faces (claim R19).
[[nodiscard]] inline glm::vec3 sphereDirection(float u, float v) {
    const float z = 1.0f - 2.0f * u;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {r * cosineOfTurns(v), r * sineOfTurns(v), z};
}

}  // namespace dustbench::maths
