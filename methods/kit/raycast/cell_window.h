// Samples a grid at sixteen positions at once: from a window of cells in registers, or from memory. Internal to the CPU
// march.
//
// The rays of a packet are so close together that usually all eight neighbours of all their samples are within 4×4×3
// cells. These are read once, and the neighbours are selected in registers: on AVX-512 this takes a seventh of the time
// of gathering them.
//
// Units: cells; positions are relative to the centre of the first cell.
#pragma once

#include <cstring>
#include <glm/glm.hpp>

#include "methods/kit/lanes/lanes.h"
#include "methods/kit/raycast/padded_cells.h"

namespace dustbench::raycast {

// --- Operations on sixteen lanes, in addition to lanes/lanes.h

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

// --- Sampling

struct Places {
    Floats x, y, z;
};

/// Interpolates linearly between the eight neighbours `value(corner)`, x fastest; shares are measured from the lower
/// ones.
template <typename Value>
[[gnu::always_inline]] inline Floats betweenEight(const Places& share, const Value& value) {
    const Floats front = mix(mix(value(0), value(1), share.x), mix(value(2), value(3), share.x), share.y);
    const Floats back = mix(mix(value(4), value(5), share.x), mix(value(6), value(7), share.x), share.y);
    return mix(front, back, share.z);
}

/// The values at the given positions, clamped to the grid.
[[gnu::always_inline]] inline Floats sampleAnywhere(const PaddedCells& cells, const Places& at) {
    const auto lower = [](const Floats& place, int count) {
        const Floats clamped = atLeast(atMost(place, all(static_cast<float>(count - 1))), all(0));
        return clamped;
    };
    const Floats x = lower(at.x, cells.cells().x), y = lower(at.y, cells.cells().y), z = lower(at.z, cells.cells().z);
    const Ints i = wholePart(x), j = wholePart(y), k = wholePart(z);
    const Places share{x - toFloats(i), y - toFloats(j), z - toFloats(k)};
    const Ints index = i + cells.row() * j + cells.slab() * k;
    const float* const origin = cells.origin();
    return betweenEight(share, [&](int corner) {
        const float* const from =
            origin + (corner & 1) + (corner & 2) / 2 * cells.row() + (corner & 4) / 4 * cells.slab();
        Floats values;
        for (int lane = 0; lane < laneCount; ++lane) values[lane] = from[index[lane]];
        return values;
    });
}

#ifdef __AVX512F__
/// A window of 4×4×3 cells.
class CellWindow {
 public:
    static constexpr bool useful = true;

    [[gnu::always_inline]] CellWindow(const float* from, std::ptrdiff_t row, std::ptrdiff_t slab) {
        for (int k = 0; k < 3; ++k, from += slab) slabs_[k] = joined(from, from + row, from + 2 * row, from + 3 * row);
    }

    /// `rowAt(k, j)`: the four cells of row j of slab k.
    template <typename RowAt>
    [[gnu::always_inline]] explicit CellWindow(const RowAt& rowAt) {
        for (int k = 0; k < 3; ++k) slabs_[k] = joined(rowAt(k, 0), rowAt(k, 1), rowAt(k, 2), rowAt(k, 3));
    }

    /// Positions relative to the centre of the first cell: less than (3, 3, 2).
    [[gnu::always_inline]] [[nodiscard]] Floats sample(const Places& at) const {
        const Ints i = wholePart(at.x), j = wholePart(at.y), k = wholePart(at.z);
        const Places share{at.x - toFloats(i), at.y - toFloats(j), at.z - toFloats(k)};
        const Ints index = i + 4 * j + 16 * k;
        return betweenEight(share, [&](int corner) {
            const Ints there = index + ((corner & 1) + 2 * (corner & 2));
            return corner < 4 ? lanes::lookUp(slabs_[0], slabs_[1], there) : lanes::lookUp(slabs_[1], slabs_[2], there);
        });
    }

 private:
    [[gnu::always_inline]] static Floats joined(const float* a, const float* b, const float* c, const float* d) {
        return joined(lanes::load<Four>(a), lanes::load<Four>(b), lanes::load<Four>(c), lanes::load<Four>(d));
    }
    [[gnu::always_inline]] static Floats joined(const Four& a, const Four& b, const Four& c, const Four& d) {
        const auto low = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
        const auto high = __builtin_shufflevector(c, d, 0, 1, 2, 3, 4, 5, 6, 7);
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    }

    Floats slabs_[3];
};
#else
/// Without such registers, gathering is faster.
class CellWindow {
 public:
    static constexpr bool useful = false;
    CellWindow(const float*, std::ptrdiff_t, std::ptrdiff_t) {}
    template <typename RowAt>
    explicit CellWindow(const RowAt&) {}
    [[nodiscard]] static Floats sample(const Places&) { return Floats{}; }
};
#endif

}  // namespace dustbench::raycast
