// The sRGB transfer function (IEC 61966-2-1) for one channel.
//
// Threads: pure.
#pragma once

#include <algorithm>
#include <cmath>

namespace dustbench::maths {

/// Clamps the argument to [0, 1]; NaN becomes 0, so that a faulty pixel does not spoil a whole file.
[[nodiscard]] inline float encodeSrgb(float linear) {
    const float value = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

[[nodiscard]] inline float decodeSrgb(float encoded) {
    const float value = encoded > 0 ? std::min(encoded, 1.0f) : 0.0f;
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

}  // namespace dustbench::maths
