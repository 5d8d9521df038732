// Vectors of numbers that the compiler maps to the available registers, and operations on all lanes at once.
//
// Vectors must not cross a library boundary: those wider than the target's registers are passed in memory.
#pragma once

#include <cstring>

namespace dustbench::lanes {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Float16 = float __attribute__((vector_size(64)));
using Double4 = double __attribute__((vector_size(32)));
using Int4 = int __attribute__((vector_size(16)));
using Unsigned4 = unsigned __attribute__((vector_size(16)));
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

/// The lane-wise minimum and maximum; `bound` if `x` is NaN.
template <typename Vector>
[[gnu::always_inline]] inline Vector atMost(const Vector& x, const Vector& bound) {
    return x < bound ? x : bound;
}
template <typename Vector>
[[gnu::always_inline]] inline Vector atLeast(const Vector& x, const Vector& bound) {
    return x > bound ? x : bound;
}

/// `table[index]` for each lane. Indices count from 0 and wrap at the number of lanes.
template <typename Vector, typename Index>
[[gnu::always_inline]] inline Vector lookUp(const Vector& table, const Index& index) {
#if defined(__clang__)  // clang-tidy; its __builtin_shufflevector takes constants only
    constexpr int count = sizeof(Index) / sizeof(int);
    Vector found{};
    for (int lane = 0; lane < count; ++lane) found[lane] = table[index[lane] & (count - 1)];
    return found;
#else
    return __builtin_shuffle(table, index);
#endif
}
/// The same for two consecutive tables; an index wraps at the total number of lanes.
template <typename Vector, typename Index>
[[gnu::always_inline]] inline Vector lookUp(const Vector& first, const Vector& second, const Index& index) {
#if defined(__clang__)
    constexpr int count = sizeof(Index) / sizeof(int);
    Vector found{};
    for (int lane = 0; lane < count; ++lane) {
        const int place = index[lane] & (2 * count - 1);
        found[lane] = place < count ? first[place] : second[place - count];
    }
    return found;
#else
    return __builtin_shuffle(first, second, index);
#endif
}

/// The same number in all lanes.
template <typename Vector>
[[gnu::always_inline]] inline Vector everywhere(float value) {
    return value - Vector{};
}

}  // namespace dustbench::lanes
