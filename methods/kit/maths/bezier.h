// Bézier curves over t in [0, 1]: cubic curves of scalars and vectors, and curves of any degree of scalars.
//
// Threads: pure. Source: Thesis, 4.4.3 (de Casteljau); Farin2002, ch. 4. Departs: uses (1 − t) for the printed weight
// (N − t), unless noted.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace dustbench::maths {

template <typename T>
[[nodiscard]] constexpr T interpolate(const T& a, const T& b, float t) {
    return a + (b - a) * t;
}

/// de Casteljau: P(i, j) = (1 − t)·P(i, j−1) + t·P(i+1, j−1), until one point remains.
template <typename T>
[[nodiscard]] constexpr T bezier(const T& p0, const T& p1, const T& p2, const T& p3, float t) {
    const T p01 = interpolate(p0, p1, t), p12 = interpolate(p1, p2, t), p23 = interpolate(p2, p3, t);
    return interpolate(interpolate(p01, p12, t), interpolate(p12, p23, t), t);
}

/// The same for any number of points, at least one.
[[nodiscard]] inline float bezier(std::span<const float> points, float t) {
    std::vector<float> left(points.begin(), points.end());
    for (std::size_t count = left.size() - 1; count > 0; --count)
        for (std::size_t i = 0; i < count; ++i) left[i] = interpolate(left[i], left[i + 1], t);
    return left.front();
}

/// The same curve as the sum of Bernstein polynomials, nested like Horner's rule: N multiplications by 1 − t in place
/// of N²/2 interpolations. `weights`: C(N, i)·P_i. Source: Farin2002, ch. 5.
[[nodiscard]] inline float bernsteinSum(std::span<const float> weights, float t) {
    float sum = weights[0], power = 1;
    for (std::size_t i = 1; i < weights.size(); ++i) {
        power *= t;
        sum = sum * (1 - t) + power * weights[i];
    }
    return sum;
}

/// C(N, i)·P_i of N + 1 points.
[[nodiscard]] inline std::vector<float> bernsteinWeights(std::span<const float> points) {
    std::vector<float> weights(points.begin(), points.end());
    double binomial = 1;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] *= static_cast<float>(binomial);
        binomial *= static_cast<double>(weights.size() - 1 - i) / static_cast<double>(i + 1);
    }
    return weights;
}

/// The same curve as c0 + c1·t + c2·t² + c3·t³: a third of the work if a curve is evaluated many times.
template <typename T>
struct CubicPolynomial {
    T c0{}, c1{}, c2{}, c3{};

    [[nodiscard]] constexpr T operator()(float t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }
};

template <typename T>
[[nodiscard]] constexpr CubicPolynomial<T> bezierPolynomial(const T& p0, const T& p1, const T& p2, const T& p3) {
    return {p0, 3.0f * (p1 - p0), 3.0f * (p0 - 2.0f * p1 + p2), p3 - p0 + 3.0f * (p1 - p2)};
}

/// With the weights as printed, (N − t)^(N−i)·t^i for N = 3. They do not sum to 1: the curve begins at 27·p0 and ends
/// at 8·p0 + 12·p1 + 6·p2 + p3.
template <typename T>
[[nodiscard]] constexpr CubicPolynomial<T> printedBezierPolynomial(const T& p0, const T& p1, const T& p2, const T& p3) {
    return {27.0f * p0, 27.0f * (p1 - p0), 9.0f * (p0 - 2.0f * p1 + p2), p3 - p0 + 3.0f * (p1 - p2)};
}

}  // namespace dustbench::maths
