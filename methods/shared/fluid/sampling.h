// Trilinear look-up of whole records, and the path that a cell's air has come along. Private to the kernels.
//
// Frame: cells from the first ghost cell's centre, so that the centre of cell (i, j, k) is at (i + 1, j + 1, k + 1).
#pragma once

#include <cstddef>
#include <cstdint>

#include "methods/shared/fluid/cell_field.h"
#include "methods/shared/fluid/lanes.h"

namespace dustbench::fluid {

/// Records as a look-up sees them. `slabs[k]` is where slab k begins, in floats, so that a window of slabs can stand
/// for the whole.
struct RecordView {
    const float* base;
    std::size_t row;             ///< floats from one row to the next
    const std::uint32_t* slabs;  ///< in floats / lanes
};

/// The eight cells around a place.
struct Corners {
    const float *low, *high;  ///< the cell at the least corner, and that in the next slab
    Float4 fraction;          ///< of the way to the next cell, 0…1
};

/// `place` must lie within `0…last`, the centres of the outermost ghost cells.
[[gnu::always_inline]] inline Corners cornersAround(const RecordView& view, const Float4& place, const Int4& lastCorner,
                                                    const CellLayout& layout) {
    Int4 whole = __builtin_convertvector(place, Int4);
    whole = whole < lastCorner ? whole : lastCorner;
    const auto x = static_cast<std::uint32_t>(whole[0]);
    const auto y = static_cast<std::uint32_t>(whole[1]);
    const auto z = static_cast<std::uint32_t>(whole[2]);
    const std::size_t inSlab = y * layout.row + x;
    Corners corners;
    corners.low = view.base + (view.slabs[z] + inSlab) * lanes;
    corners.high = view.base + (view.slabs[z + 1] + inSlab) * lanes;
    corners.fraction = place - __builtin_convertvector(whole, Float4);
    return corners;
}

/// Two neighbours in x lie side by side: four reads bring all eight.
struct CornerPairs {
    [[gnu::always_inline]] CornerPairs(const Corners& corners, std::size_t row)
        : a(load<Float16>(corners.low)),
          b(load<Float16>(corners.low + row)),
          c(load<Float16>(corners.high)),
          d(load<Float16>(corners.high + row)) {}
    Float16 a, b, c, d;
};

/// The first of two neighbours, and the second.
[[gnu::always_inline]] inline Float8 firstOf(const Float16& pair) {
    return __builtin_shufflevector(pair, pair, 0, 1, 2, 3, 4, 5, 6, 7);
}
[[gnu::always_inline]] inline Float8 secondOf(const Float16& pair) {
    return __builtin_shufflevector(pair, pair, 6, 7, 8, 9, 10, 11, 12, 13);
}

/// Six lanes of the record at a place, and two more that mean nothing.
[[gnu::always_inline]] inline Float8 sample(const Corners& corners, std::size_t row) {
    const CornerPairs pairs(corners, row);
    const float fx = corners.fraction[0], fy = corners.fraction[1], fz = corners.fraction[2];
    const Float16 nearSlab = pairs.a * (1 - fy) + pairs.b * fy;
    const Float16 farSlab = pairs.c * (1 - fy) + pairs.d * fy;
    const Float16 both = nearSlab * (1 - fz) + farSlab * fz;
    return firstOf(both) * (1 - fx) + secondOf(both) * fx;
}

/// Least and greatest value of the eight cells, lane by lane.
[[gnu::always_inline]] inline void extrema(const Corners& corners, std::size_t row, Float8& least, Float8& most) {
    const CornerPairs pairs(corners, row);
    const Float16 low = atMost(atMost(pairs.a, pairs.b), atMost(pairs.c, pairs.d));
    const Float16 high = atLeast(atLeast(pairs.a, pairs.b), atLeast(pairs.c, pairs.d));
    least = atMost(firstOf(low), secondOf(low));
    most = atLeast(firstOf(high), secondOf(high));
}

}  // namespace dustbench::fluid
