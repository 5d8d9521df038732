// Elementary functions by arithmetic only: loops over them vectorise, and they give the same bits in every build and at
// any vector width, as long as the build fuses operations alike.
//
// Threads: pure.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace dustbench::maths {

/// Added to a small number, it leaves the nearest integer in the lowest bits of the sum.
inline constexpr double roundingMagic = 0x1.8p52;

/// ln2^k / k!, k = 0..9: Taylor series of 2^x.
inline constexpr std::array<double, 10> powerSeries = [] {
    std::array<double, 10> series{};
    double term = 1;
    for (int k = 0; k < 10; ++k) {
        series[static_cast<std::size_t>(k)] = term;
        term *= std::numbers::ln2 / (k + 1);
    }
    return series;
}();

/// 2^x, relative error below 1e-11, for |x| ≤ 1000. 2^x = 2^n·2^f with integer n and |f| ≤ ½; the first omitted term is
/// (ln2/2)^10/10! = 7e-12.
[[nodiscard]] inline double powerOfTwo(double x) {
    const auto& [c0, c1, c2, c3, c4, c5, c6, c7, c8, c9] = powerSeries;
    const double shifted = x + roundingMagic;
    const double f = x - (shifted - roundingMagic);
    // In pairs, to shorten the dependency chain.
    const double f2 = f * f, f4 = f2 * f2;
    const double low = (c0 + c1 * f) + (c2 + c3 * f) * f2;
    const double high = (c4 + c5 * f) + (c6 + c7 * f) * f2;
    const double power = low + f4 * (high + f4 * (c8 + c9 * f));
    // Moves n from the sum's lowest bits to the exponent; unsigned, so that a negative n wraps correctly.
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(power) + (std::bit_cast<std::uint64_t>(shifted) << 52));
}

/// ½·erf(z), absolute error below 5e-11 for |z| ≤ 6/√2; beyond, it is constant, 1e-9 from ±½.
///
/// erf(z)/z is even: a polynomial of degree 20 in u = z²/9 − 1, which ranges from −1 to 1, interpolated at the
/// Chebyshev points. (A table would be shorter, but gathering from it is slower than this.)
class HalfErrorFunction {
 public:
    static constexpr double limit = 3 * std::numbers::sqrt2;  ///< 6/√2

    [[nodiscard]] static const HalfErrorFunction& instance() {
        static const HalfErrorFunction function;
        return function;
    }

    [[nodiscard]] double operator()(double z) const {
        const double above = z < -limit ? -limit : z;
        const double x = above > limit ? limit : above;
        const double u = x * x * (2 / (limit * limit)) - 1;
        const double u2 = u * u, u4 = u2 * u2;
        double sum = c_[20];
#pragma GCC unroll 5
        for (std::size_t k = 20; k > 0;) {
            k -= 4;
            sum = sum * u4 + ((c_[k] + c_[k + 1] * u) + (c_[k + 2] + c_[k + 3] * u) * u2);
        }
        return x * sum;
    }

 private:
    static constexpr std::size_t degree = 20;

    HalfErrorFunction() {
        // Σ bⱼ·Tⱼ(u) through the degree + 1 zeros of T: bⱼ = 2/n·Σ f(cos θ)·cos(jθ), half of it for j = 0.
        constexpr std::size_t n = degree + 1;
        std::array<double, n> b{};
        for (std::size_t k = 0; k < n; ++k) {
            const double angle = std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
            const double z = limit * std::sqrt((std::cos(angle) + 1) / 2);
            for (std::size_t j = 0; j < n; ++j)
                b[j] += std::erf(z) / (2 * z) * std::cos(static_cast<double>(j) * angle) * (j == 0 ? 1.0 : 2.0) /
                        static_cast<double>(n);
        }
        // In powers of u, by T₀ = 1, T₁ = u, Tⱼ₊₁ = 2u·Tⱼ − Tⱼ₋₁.
        std::array<double, n> before{1}, now{0, 1};
        c_[0] = b[0];
        for (std::size_t j = 1; j < n; ++j) {
            for (std::size_t k = 0; k <= j; ++k) c_[k] += b[j] * now[k];
            std::array<double, n> next{};
            for (std::size_t k = 0; k < n; ++k) next[k] = (k > 0 ? 2 * now[k - 1] : 0) - before[k];
            before = now;
            now = next;
        }
    }

    std::array<double, degree + 1> c_{};
};

// Single precision: sine and cosine of an angle in turns (1 = 2π), and the natural logarithm.

/// Rounds to the nearest integer, ties to even, for |v| < 2²²: adding 1.5·2²³ leaves no fractional bits.
[[nodiscard]] inline float roundToInteger(float v) {
    constexpr float shift = 0x1.8p23f;
    return (v + shift) - shift;
}

/// sin(2πf) for f in [−¼, ¼]: the odd minimax polynomial of degree 9 (Lawson's iteration), error 4e-9.
[[nodiscard]] inline float sineOfQuarter(float f) {
    const float f2 = f * f;
    return f * (6.28318501f + f2 * (-41.34165573f + f2 * (81.60100555f + f2 * (-76.54977417f + f2 * 39.53666306f))));
}

/// sin(2π·turns) for |turns| < 2²¹, absolute error below 5e-7 for the argument as given: removes whole turns, r in [−½,
/// ½]; then sin(2πr) = sin(2π·(±½ − r)) folds r into [−¼, ¼].
[[nodiscard]] inline float sineOfTurns(float turns) {
    const float r = turns - roundToInteger(turns);
    const float rising = std::fabs(r), falling = 0.5f - rising;
    return sineOfQuarter(std::copysign(rising < falling ? rising : falling, r));
}

/// cos(2πr) = sin(2π·(¼ − |r|)).
[[nodiscard]] inline float cosineOfTurns(float turns) {
    return sineOfQuarter(0.25f - std::fabs(turns - roundToInteger(turns)));
}

/// log v of a normal positive v; relative error below 3e-7 outside 0.99..1.01, absolute error below 1e-8 there.
///
/// v = m·2ᵉ with m in [√½, √2); log m = 2·artanh(t) with t = (m − 1)/(m + 1), |t| < 0.172: the series to t⁹.
[[nodiscard]] inline float naturalLogarithm(float v) {
    constexpr std::uint32_t rootOfHalf = 0x3f3504f3;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(v) - rootOfHalf;
    const float exponent = static_cast<float>(static_cast<std::int32_t>(bits) >> 23);
    const float m = std::bit_cast<float>((bits & 0x007fffffu) + rootOfHalf);
    const float t = (m - 1.0f) / (m + 1.0f), t2 = t * t;
    const float series = t * (2.0f + t2 * (0.66666667f + t2 * (0.4f + t2 * (0.28571429f + t2 * 0.22222222f))));
    return exponent * 0.69314718f + series;
}

}  // namespace dustbench::maths
