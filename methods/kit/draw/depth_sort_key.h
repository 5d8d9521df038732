// Maps depths to integers whose ascending order is far to near, and packs them with the point's index into one key.
#pragma once

#include <bit>
#include <cstdint>

namespace dustbench::draw {

/// The key of a depth: the larger the depth, the smaller the key. −0 and 0 have the same key.
[[nodiscard]] inline std::uint32_t farFirstKey(float depth) {
    // Floats order as their bits do, negative ones in reverse: flip the sign bit if positive, all bits if negative.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(depth + 0.0f);
    const std::uint32_t flip = static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> 31) | 0x80000000u;
    return ~(bits ^ flip);
}

/// Ascending order is far to near; ties by index.
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
