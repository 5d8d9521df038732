// Vector operations of the fluid kernels in addition to lanes/lanes.h. Internal.
#pragma once

#ifdef __FMA__
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "methods/kit/lanes/lanes.h"

namespace dustbench::grid_fluid::flow {

using lanes::atLeast;
using lanes::atMost;
using lanes::everywhere;
using lanes::Float16;
using lanes::Float4;
using lanes::Float8;
using lanes::Int16;
using lanes::load;
using lanes::store;

/// Whether one instruction processes a whole Float16.
#ifdef __AVX512F__
inline constexpr bool sixteenAtOnce = true;
#else
inline constexpr bool sixteenAtOnce = false;
#endif

/// Sixteen bytes converted to integers.
[[gnu::always_inline]] inline Int16 widened(const std::uint8_t* bytes) {
    Int16 numbers;
#ifdef __AVX512F__
    const __m512i wide = _mm512_maskz_cvtepu8_epi32(0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes)));
    std::memcpy(&numbers, &wide, sizeof numbers);
#else
    for (int i = 0; i < 16; ++i) numbers[i] = bytes[i];
#endif
    return numbers;
}

/// Writes the `values` whose `condition` is -1 instead of 0 consecutively, and returns their number; `to` must have
/// room for sixteen.
[[gnu::always_inline]] inline std::size_t storeWhere(const Int16& condition, const Int16& values, int* to) {
#ifdef __AVX512F__
    const __mmask16 those =
        _mm512_test_epi32_mask(std::bit_cast<__m512i>(condition), std::bit_cast<__m512i>(condition));
    store(to, _mm512_maskz_compress_epi32(those, std::bit_cast<__m512i>(values)));
    return static_cast<std::size_t>(std::popcount(those));
#else
    std::size_t count = 0;
    for (int lane = 0; lane < 16; ++lane) {
        to[count] = values[lane];
        count += condition[lane] != 0 ? 1 : 0;
    }
    return count;
#endif
}

/// a·b + c per lane, rounded once. Without a hardware instruction it is computed by a slower equivalent, so that all
/// builds give the same results.
template <typename Vector>
[[gnu::always_inline]] inline Vector fused(const Vector& a, const Vector& b, const Vector& c) {
#ifdef __AVX512F__
    if constexpr (sizeof(Vector) == 64) return _mm512_fmadd_ps(a, b, c);
#endif
#ifdef __FMA__
    if constexpr (sizeof(Vector) == 32) return _mm256_fmadd_ps(a, b, c);
    if constexpr (sizeof(Vector) == 16) return _mm_fmadd_ps(a, b, c);
#endif
    Vector result;
    for (std::size_t i = 0; i < sizeof(Vector) / sizeof(float); ++i) result[i] = std::fma(a[i], b[i], c[i]);
    return result;
}

/// a + share·(b − a), lane by lane, with a share for each lane.
template <typename Vector>
[[gnu::always_inline]] inline Vector mixed(const Vector& a, const Vector& b, const Vector& share) {
    return fused(share, b - a, a);
}
/// The same with one share.
template <typename Vector>
[[gnu::always_inline]] inline Vector mix(const Vector& a, const Vector& b, float share) {
    return fused(everywhere<Vector>(share), b - a, a);
}

}  // namespace dustbench::grid_fluid::flow
