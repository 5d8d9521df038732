// Depths as integers whose ascending order is far to near, joined with the point's index into one sortable number.
#pragma once

#include <bit>
#include <cstdint>

namespace dustbench::draw {

/// The key of a depth: the larger the depth, the smaller the key; −0 and 0 are one depth.
[[nodiscard]] inline std::uint32_t farFirstKey(float depth) {
    // Floats order as their bits do, negative ones in reverse: flip the sign of the former, all of the latter.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(depth + 0.0f);
    const std::uint32_t flip = static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 31) | 0x80000000u;
    return ~(bits ^ flip);
}

/// Ascending order is far to near, and by index among equals.
[[nodiscard]] inline std::uint64_t keyedIndex(std::uint32_t key, std::size_t index) {
    return static_cast<std::uint64_t>(key) << 32 | static_cast<std::uint32_t>(index);
}

[[nodiscard]] inline std::uint32_t keyOf(std::uint64_t keyed) {
    return static_cast<std::uint32_t>(keyed >> 32);
}

[[nodiscard]] inline std::uint32_t indexOf(std::uint64_t keyed) {
    return static_cast<std::uint32_t>(keyed);
}

}  // namespace dustbench::draw
