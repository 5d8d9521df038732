// Random points and directions from uniform numbers: the disc, the ball, the triangle, the cone, the sphere.
//
// Units: metres, turns and cosines as named. Threads: pure.
// Source: Thesis, 4.2.3 (sphere), 4.2.4 (disc), 4.3.1 (random direction), 4.3.2 and 4.3.3 (cones). Departs: see below.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/kit/maths/fast_functions.h"

namespace dustbench::maths {

/// `paper`: the formula as printed. `fixed`: a formula with the distribution that the paper states.
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

/// Directions within a half angle βmax of an axis, and at least βmin from it.
/// paper: β = βmin + √u·(βmax − βmin), which the paper calls uniform; true only for small cones (claim R20).
/// fixed: cos β = cos βmin − u·(cos βmin − cos βmax), uniform on the zone by Archimedes.
class Cone {
 public:
    /// `axis`: a unit vector. The inner half angle is at most the outer one.
    Cone(SamplingMode mode, glm::vec3 axis, float halfAngleTurns, float innerHalfAngleTurns = 0)
        : mode_(mode),
          innerTurns_(innerHalfAngleTurns),
          widthTurns_(halfAngleTurns - innerHalfAngleTurns),
          innerDepth_(depthOf(innerHalfAngleTurns)),
          depth_(depthOf(halfAngleTurns) - innerDepth_),
          axis_(axis),
          frame_(tangentsOf(axis)) {}

    [[nodiscard]] glm::vec3 direction(float u, float v) const {
        float cosine, sine;
        if (mode_ == SamplingMode::paper) {
            const float angle = innerTurns_ + std::sqrt(u) * widthTurns_;
            cosine = cosineOfTurns(angle);
            sine = sineOfTurns(angle);
        } else {
            const float depth = innerDepth_ + u * depth_;
            cosine = 1.0f - depth;
            sine = std::sqrt(std::max(0.0f, depth * (2.0f - depth)));  // rounding may take a depth beyond 2
        }
        return sine * cosineOfTurns(v) * frame_.first + sine * sineOfTurns(v) * frame_.second + cosine * axis_;
    }

 private:
    /// 1 − cos β, without cancellation.
    [[nodiscard]] static float depthOf(float turns) {
        const float half = sineOfTurns(turns / 2);
        return 2.0f * half * half;
    }

    SamplingMode mode_;
    float innerTurns_, widthTurns_;
    float innerDepth_;  ///< 1 − cos βmin
    float depth_;       ///< cos βmin − cos βmax
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

/// The thesis's random direction: a vector of random components, normalised. Not uniform (claim R19).
[[nodiscard]] inline glm::vec3 cubeDirection(float u, float v, float w) {
    const glm::vec3 point = 2.0f * glm::vec3(u, v, w) - 1.0f;
    const float length = glm::length(point);
    return length > 0 ? point / length : glm::vec3(0, 1, 0);
}

/// Uniform in the unit ball: a uniform direction at the distance r = max(a, b, c), as P(max ≤ r) = r³.
[[nodiscard]] inline glm::vec3 ballPoint(float u, float v, float a, float b, float c) {
    return std::max({a, b, c}) * sphereDirection(u, v);
}

/// Uniform in the unit ball by rejection: the first of the points `cubePoint(k)`, uniform in the cube [−1, 1)³, that
/// lies in the ball. Takes 1.91 tries on average.
template <typename CubePoint>
[[nodiscard]] glm::vec3 ballPointByRejection(const CubePoint& cubePoint) {
    glm::vec3 point = cubePoint(0);
    for (std::uint32_t k = 1; glm::dot(point, point) > 1.0f; ++k) point = cubePoint(k);
    return point;
}

/// In the unit ball with both angles and the distance uniform: α ∈ [0, 2π), β ∈ [−π/2, π/2), d ∈ [0, 1). The thesis's
/// source that is dense at the centre: its density is ∝ 1/(d²·cos β), so it is dense around the poles too.
[[nodiscard]] inline glm::vec3 denseBallPoint(float u, float v, float w) {
    const float latitude = 0.5f * v - 0.25f;  // turns
    const float ring = w * cosineOfTurns(latitude);
    return {ring * cosineOfTurns(u), w * sineOfTurns(latitude), ring * sineOfTurns(u)};
}

/// Uniform on a triangle, as weights of its corners. Source: Turk1990.
[[nodiscard]] inline glm::vec3 triangleWeights(float u, float v) {
    const float root = std::sqrt(u);
    return {1.0f - root, root * (1.0f - v), root * v};
}

}  // namespace dustbench::maths
