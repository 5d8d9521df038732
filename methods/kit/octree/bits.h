// Operations on the bits and bytes of words in parallel. Internal to the builders.
//
// Threads: pure.
#pragma once

#ifdef __AVX512BW__
#include <immintrin.h>
#endif

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

namespace dustbench::octree {

[[nodiscard]] constexpr std::uint32_t bitCount(std::uint64_t bits) {
    return static_cast<std::uint32_t>(std::popcount(bits));
}

/// Maps bit k of eight to byte k.
[[nodiscard]] constexpr std::uint64_t bitsToBytes(std::uint64_t bits) {
    return ((bits * 0x0101'0101'0101'0101ull & 0x8040'2010'0804'0201ull) + 0x7f7f'7f7f'7f7f'7f7full) >> 7 &
           0x0101'0101'0101'0101ull;
}

/// Number of set bits in each byte.
[[nodiscard]] constexpr std::uint64_t byteCounts(std::uint64_t bits) {
    bits -= bits >> 1 & 0x5555'5555'5555'5555ull;
    bits = (bits & 0x3333'3333'3333'3333ull) + (bits >> 2 & 0x3333'3333'3333'3333ull);
    return (bits + (bits >> 4)) & 0x0f0f'0f0f'0f0f'0f0full;
}

/// For each byte, the sum of the bytes before it.
[[nodiscard]] constexpr std::uint64_t sumsBefore(std::uint64_t bytes) {
    return (bytes * 0x0101'0101'0101'0101ull) << 8;
}

/// One bit for each of 64 bytes, set if the byte is not 0.
[[nodiscard]] inline std::uint64_t whichAreSet(const void* bytes) {
#ifdef __AVX512BW__
    const __m512i all = _mm512_loadu_si512(bytes);
    return _mm512_test_epi8_mask(all, all);
#else
    std::uint64_t bits = 0;
    for (int i = 0; i < 64; ++i) bits |= std::uint64_t{static_cast<const std::uint8_t*>(bytes)[i] != 0} << i;
    return bits;
#endif
}

alignas(64) inline constexpr std::array<std::uint16_t, 32> zeroTo31 = [] {
    std::array<std::uint16_t, 32> numbers{};
    std::iota(numbers.begin(), numbers.end(), std::uint16_t{0});
    return numbers;
}();

/// The indices of the bits set in `words`, ascending. May write up to 31 extra numbers after the last. Returns their
/// count.
inline std::uint32_t numbersOfBits(std::span<const std::uint64_t> words, std::uint16_t* numbers) {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
#ifdef __AVX512VBMI2__
        for (const std::size_t first : {64 * i, 64 * i + 32}) {
            const auto bits = static_cast<std::uint32_t>(words[i] >> first % 64);
            const __m512i all =
                _mm512_add_epi16(_mm512_load_si512(zeroTo31.data()), _mm512_set1_epi16(static_cast<short>(first)));
            _mm512_storeu_si512(numbers + count, _mm512_maskz_compress_epi16(bits, all));
            count += bitCount(bits);
        }
#else
        for (std::uint64_t left = words[i]; left != 0; left &= left - 1)
            numbers[count++] = static_cast<std::uint16_t>(64 * i + static_cast<std::size_t>(std::countr_zero(left)));
#endif
    }
    return count;
}

}  // namespace dustbench::octree
