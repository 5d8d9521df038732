// Iterates over sparse flags, testing eight at a time.
//
// Threads: pure.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dustbench::particles {

/// Calls `visit(i)` for each of `count` flags that is 1, in ascending order; all flags must be 0 or 1.
template <typename Visit>
void forEachFlagged(const std::uint8_t* flags, std::size_t count, const Visit& visit) {
    static_assert(std::endian::native == std::endian::little, "the lowest byte of a word is the first flag");
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, flags + i, sizeof eight);
        for (; eight != 0; eight &= eight - 1) visit(i + static_cast<std::size_t>(std::countr_zero(eight)) / 8);
    }
    for (; i < count; ++i)
        if (flags[i]) visit(i);
}

}  // namespace dustbench::particles
