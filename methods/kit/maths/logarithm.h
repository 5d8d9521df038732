// The natural logarithm by arithmetic only: vectorises, and gives the same bits in every build.
//
// Range: normal positive floats; relative error below 3e-7 outside 0.99..1.01, absolute error below 1e-8 there.
// Threads: pure.
#pragma once

#include <bit>
#include <cstdint>

namespace dustbench::maths {

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
