// Unsigned keys by which a RadixSort orders depths, front to back or back to front.
//
// Equal depths keep the order of their indices in both directions. Threads: the OpenGL thread's.
#pragma once

#include <bit>
#include <cstdint>

#include "methods/kit/gpu/sort/tile_plan.h"

namespace dustbench::gpu {

/// Orders like the floats, except NaN; both zeros have one key. Equals the function of sortable.glsl.
[[nodiscard]] constexpr std::uint32_t sortableKey(float value) {
    constexpr std::uint32_t sign = 0x80000000;
    const auto bits = std::bit_cast<std::uint32_t>(value == 0 ? 0.0f : value);
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

enum class DepthOrder { frontToBack, backToFront };

class DUSTBENCH_API DepthKeys {
 public:
    DepthKeys(Device& device, std::uint32_t capacity);

    /// Writes a key for each depth, and the indices 0, 1, 2 …
    void write(const Buffer& depths, const ElementCount& count, DepthOrder order, Buffer& keys, Buffer& indices);

 private:
    TilePlan plan_;
    Program program_;
};

}  // namespace dustbench::gpu
