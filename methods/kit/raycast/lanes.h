// Operations on sixteen lanes, in addition to lanes/lanes.h. Internal to the CPU march.
#pragma once

#include <cstring>

#include "methods/kit/lanes/lanes.h"

namespace dustbench::raycast {

inline constexpr int laneCount = 16;
using Floats = lanes::Float16;
using Ints = lanes::Int16;
/// x, y, z, and an unused lane.
using Four = lanes::Float4;
using FourInts = lanes::Int4;
using lanes::atLeast;
using lanes::atMost;

[[gnu::always_inline]] inline Floats all(float value) {
    return lanes::everywhere<Floats>(value);
}
[[gnu::always_inline]] inline Ints wholePart(const Floats& a) {
    return __builtin_convertvector(a, Ints);
}
[[gnu::always_inline]] inline Floats toFloats(const Ints& a) {
    return __builtin_convertvector(a, Floats);
}
[[gnu::always_inline]] inline Floats mix(const Floats& a, const Floats& b, const Floats& share) {
    return a + share * (b - a);
}

[[gnu::always_inline]] inline float minimum(const Floats& a) {
    float result = a[0];
    for (int i = 1; i < laneCount; ++i) result = a[i] < result ? a[i] : result;
    return result;
}
[[gnu::always_inline]] inline float maximum(const Floats& a) {
    float result = a[0];
    for (int i = 1; i < laneCount; ++i) result = a[i] > result ? a[i] : result;
    return result;
}

/// e^(−x) for x ≥ 0, with relative error below 1e-6; 0 if the result is below 2^-126.
[[gnu::always_inline]] inline Floats expMinus(const Floats& x) {
    // e^(−x) = 2^(−n)·2^f with −x/ln 2 = f − n, f in [0, 1); 2^f by its series about ½, to the sixth power.
    const Floats y = atMost(x * 1.44269504f, all(126));
    const Ints n = wholePart(y) + 1;
    const Floats f = toFloats(n) - y, h = (f - 0.5f) * 0.69314718f;
    const Floats series =
        1 + h * (1 + h * (0.5f + h * (1.0f / 6 + h * (1.0f / 24 + h * (1.0f / 120 + h * (1.0f / 720))))));
    const Ints bits = (127 - n) << 23;
    Floats scale;
    std::memcpy(&scale, &bits, sizeof scale);
    return 1.41421356f * series * scale;
}

}  // namespace dustbench::raycast
