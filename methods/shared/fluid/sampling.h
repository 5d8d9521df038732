// Trilinear look-up of whole records, for a strip of cells at a time. Private to the kernels.
//
// Where the look-ups of all cells begin comes first, four cells in a vector; then cell by cell what is found there, six
// quantities in a vector, so that many reads are in flight at once.
// Frame: cells from the first ghost cell's centre, so that the centre of cell (i, j, k) is at (i + 1, j + 1, k + 1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "methods/shared/fluid/cell_field.h"
#include "methods/shared/fluid/lanes.h"

namespace dustbench::fluid {

/// So many cells of a row are taken together.
inline constexpr std::size_t stripCells = 64;

/// A place for each cell: x, y, z, and a number that means nothing.
using Places = std::array<Float4, stripCells>;
/// Four of them, from number `i` on.
[[gnu::always_inline]] inline Float16 fourPlaces(const Places& places, std::size_t i) {
    return load<Float16>(reinterpret_cast<const float*>(&places[i]));
}
[[gnu::always_inline]] inline Float16 fourTimes(const Float4& v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
}
[[gnu::always_inline]] inline Int16 fourTimes(const Int4& v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
}

/// A field in memory: whole, or as a ring of slabs, in which slab k is number k mod `slabs`.
struct RecordView {
    const float* base;
    int slabs;
};

/// The eight cells around each place of a strip.
template <bool ring>
class CornerStrip {
 public:
    CornerStrip(const RecordView& view, const CellLayout& layout)
        : view_(view),
          row_(layout.row * lanes),
          slab_(layout.slab * lanes),
          lastCorner_(fourTimes(Int4{layout.nx, layout.ny, layout.nz, 0})),
          strides_(fourTimes(Int4{1, static_cast<int>(layout.row), static_cast<int>(layout.slab), 0})),
          slabs_(fourTimes(Int4{0, 0, view.slabs, 0})) {}

    /// Of a ring: slabs from here on will be looked at, no more than there are.
    void lookFrom(int slab) { shift_ = fourTimes(Int4{0, 0, slab % view_.slabs - slab, 0}); }

    /// All places must lie within `0…last`, the centres of the outermost ghost cells. Those up to the next multiple of
    /// four are looked at.
    [[gnu::always_inline]] void find(const Places& places, std::size_t count) {
        for (std::size_t i = 0; i < count; i += 4) {
            const Float16 place = fourPlaces(places, i);
            const Int16 corner = atMost(__builtin_convertvector(place, Int16), lastCorner_);
            store(reinterpret_cast<float*>(&fractions_[i]), place - __builtin_convertvector(corner, Float16));
            if constexpr (ring) {
                const Int16 low = corner + shift_;
                store(&low_[i], recordsOf(inRing(low)));
                store(&high_[i], recordsOf(inRing(low + nextSlab)));
            } else {
                store(&low_[i], recordsOf(corner));
            }
        }
    }

    /// Six quantities at place `i`, and two numbers that mean nothing.
    [[gnu::always_inline]] Float8 sample(std::size_t i) const {
        const float fx = fractions_[i][0], fy = fractions_[i][1], fz = fractions_[i][2];
        const auto along = [&](const auto& c) { return mix(mix(c.a, c.b, fy), mix(c.c, c.d, fy), fz); };
        if constexpr (sixteenAtOnce) {
            const Float16 both = along(column<Float16>(i, 0));
            return mix(firstOf(both), secondOf(both), fx);
        } else {
            return mix(along(column<Float8>(i, 0)), along(column<Float8>(i, lanes)), fx);
        }
    }
    /// Least and greatest value of the eight cells, quantity by quantity.
    [[gnu::always_inline]] void extrema(std::size_t i, Float8& least, Float8& most) const {
        const auto leastOf = [](const auto& c) { return atMost(atMost(c.a, c.b), atMost(c.c, c.d)); };
        const auto mostOf = [](const auto& c) { return atLeast(atLeast(c.a, c.b), atLeast(c.c, c.d)); };
        if constexpr (sixteenAtOnce) {
            const auto both = column<Float16>(i, 0);
            const Float16 low = leastOf(both), high = mostOf(both);
            least = atMost(firstOf(low), secondOf(low));
            most = atLeast(firstOf(high), secondOf(high));
        } else {
            const auto first = column<Float8>(i, 0), second = column<Float8>(i, lanes);
            least = atMost(leastOf(first), leastOf(second));
            most = atLeast(mostOf(first), mostOf(second));
        }
    }

 private:
    static constexpr Int16 nextSlab{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};

    /// Four records of equal x, those of larger y second, of larger z last; in a Float16 each with its neighbour in x,
    /// which lies beside it.
    template <typename Vector>
    struct Column {
        Vector a, b, c, d;
    };
    template <typename Vector>
    [[gnu::always_inline]] Column<Vector> column(std::size_t i, std::size_t from) const {
        const float* low = view_.base + std::size_t{low_[i]} * lanes + from;
        const float* high = ring ? view_.base + std::size_t{high_[i]} * lanes + from : low + slab_;
        return {load<Vector>(low), load<Vector>(low + row_), load<Vector>(high), load<Vector>(high + row_)};
    }
    [[gnu::always_inline]] static Float8 firstOf(const Float16& both) {
        return __builtin_shufflevector(both, both, 0, 1, 2, 3, 4, 5, 6, 7);
    }
    [[gnu::always_inline]] static Float8 secondOf(const Float16& both) {
        return __builtin_shufflevector(both, both, 6, 7, 8, 9, 10, 11, 12, 13);
    }
    [[gnu::always_inline]] Int16 inRing(const Int16& cell) const { return cell - ((cell >= slabs_) & slabs_); }
    /// x + y·row + z·slab of four cells.
    [[gnu::always_inline]] Int4 recordsOf(const Int16& cell) const {
        Int16 sum = cell * strides_;
        sum += __builtin_shufflevector(sum, sum, 1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14);
        sum += __builtin_shufflevector(sum, sum, 2, 3, 0, 1, 6, 7, 4, 5, 10, 11, 8, 9, 14, 15, 12, 13);
        return __builtin_shufflevector(sum, sum, 0, 4, 8, 12);
    }

    RecordView view_;
    std::size_t row_, slab_;
    Int16 lastCorner_, strides_, slabs_, shift_{};
    std::array<Float4, stripCells> fractions_{};  ///< of the way to the next cell, 0…1
    std::array<std::uint32_t, stripCells> low_{}, high_{};
};

}  // namespace dustbench::fluid
