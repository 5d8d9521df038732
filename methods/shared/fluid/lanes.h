// Vectors of floats that the compiler maps to whatever registers there are. Private to the kernels.
#pragma once

#include <cstring>

namespace dustbench::fluid {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Int4 = int __attribute__((vector_size(16)));
using Int16 = int __attribute__((vector_size(64)));

/// Whether one instruction works on a Float16.
#ifdef __AVX512F__
inline constexpr bool sixteenAtOnce = true;
#else
inline constexpr bool sixteenAtOnce = false;
#endif

template <typename Vector>
[[gnu::always_inline]] inline Vector load(const float* from) {
    Vector vector;
    std::memcpy(&vector, from, sizeof(Vector));
    return vector;
}

template <typename Number, typename Vector>
[[gnu::always_inline]] inline void store(Number* to, const Vector& vector) {
    std::memcpy(to, &vector, sizeof(Vector));
}

/// The smaller and the greater of two, lane by lane; `bound` where `x` is not a number.
template <typename Vector>
[[gnu::always_inline]] inline Vector atMost(const Vector& x, const Vector& bound) {
    return x < bound ? x : bound;
}
template <typename Vector>
[[gnu::always_inline]] inline Vector atLeast(const Vector& x, const Vector& bound) {
    return x > bound ? x : bound;
}

/// a + share·(b − a), lane by lane.
template <typename Vector>
[[gnu::always_inline]] inline Vector mix(const Vector& a, const Vector& b, float share) {
    return a + share * (b - a);
}

}  // namespace dustbench::fluid
