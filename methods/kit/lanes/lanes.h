// Vectors of numbers that the compiler maps to whatever registers there are, and what kernels do with all lanes at
// once.
//
// None crosses a library's border: vectors wider than the target's registers are passed in memory.
#pragma once

#include <cstring>

namespace dustbench::lanes {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Int4 = int __attribute__((vector_size(16)));
using Int16 = int __attribute__((vector_size(64)));

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

/// The smaller and the larger of two, lane by lane; `bound` where `x` is not a number.
template <typename Vector>
[[gnu::always_inline]] inline Vector atMost(const Vector& x, const Vector& bound) {
    return x < bound ? x : bound;
}
template <typename Vector>
[[gnu::always_inline]] inline Vector atLeast(const Vector& x, const Vector& bound) {
    return x > bound ? x : bound;
}

/// The same number in all lanes.
template <typename Vector>
[[gnu::always_inline]] inline Vector everywhere(float value) {
    return value - Vector{};
}

}  // namespace dustbench::lanes
