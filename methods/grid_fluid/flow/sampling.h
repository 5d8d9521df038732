// Trilinear sampling of whole records, for a strip of cells at a time. Internal to the kernels.
//
// First the positions of all samples are computed, sixteen cells per vector; then the samples are read cell by cell,
// six quantities per vector, so that many reads are in flight at once.
// Frame: cells from the first ghost cell's centre, so that the centre of cell (i, j, k) is at (i + 1, j + 1, k + 1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/sixteen_records.h"

namespace dustbench::grid_fluid::flow {

/// Number of cells of a row processed together.
inline constexpr std::size_t stripCells = 64;

/// Positions or velocities of sixteen cells.
struct Triples {
    Float16 x, y, z;
};

/// The velocities at the beginning of each of sixteen records.
[[gnu::always_inline]] inline Triples velocitiesOf(const float* records) {
    if constexpr (sixteenAtOnce) {
        const SixteenRecords all(records);
        return {all.get<0>(), all.get<1>(), all.get<2>()};
    } else {
        Triples velocities;
        for (std::size_t i = 0; i < SixteenRecords::count; ++i, records += lanes) {
            velocities.x[i] = records[0];
            velocities.y[i] = records[1];
            velocities.z[i] = records[2];
        }
        return velocities;
    }
}

/// A field in memory: whole, or as a ring of slabs, in which slab k has index k mod `slabs`.
struct RecordView {
    const float* base;
    int slabs;
};

/// The eight cells around each position of a strip.
template <bool ring>
class CornerStrip {
 public:
    CornerStrip(const RecordView& view, const CellLayout& layout)
        : view_(view), last_{layout.nx, layout.ny, layout.nz}, row_(layout.row * lanes), slab_(layout.slab * lanes) {}

    /// For a ring: samples will use slabs from here on, at most as many as the ring holds.
    void lookFrom(int slab) { shift_ = slab % view_.slabs - slab; }

    /// `placesOf(i)`: the Triples of cells i to i + 15, up to the next multiple of sixteen. All sampled positions must
    /// lie within `0…last`, the centres of the outermost ghost cells.
    template <typename PlacesOf>
    [[gnu::always_inline]] void find(std::size_t count, const PlacesOf& placesOf) {
        const int row = static_cast<int>(row_), slab = static_cast<int>(slab_);
        for (std::size_t i = 0; i < count; i += SixteenRecords::count) {
            const Triples place = placesOf(i);
            const Int16 x = cellAlong<0>(place.x, i), y = cellAlong<1>(place.y, i), z = cellAlong<2>(place.z, i);
            const Int16 inSlab = x * static_cast<int>(lanes) + y * row;
            if constexpr (ring) {
                store(&low_[i], inSlab + inRing(z + shift_) * slab);
                store(&high_[i], inSlab + inRing(z + (shift_ + 1)) * slab);
            } else {
                store(&low_[i], inSlab + z * slab);
            }
        }
    }

    /// Reads the samples found, cell by cell. Copies what it needs, so that it can stay in registers.
    class Reader {
     public:
        explicit Reader(const CornerStrip& strip)
            : base_(strip.view_.base),
              row_(strip.row_),
              slab_(strip.slab_),
              fractions_(strip.fractions_.data()->data()),
              low_(strip.low_.data()),
              high_(strip.high_.data()) {}

        /// Six quantities at position `i`, and two meaningless numbers.
        [[gnu::always_inline]] Float8 sample(std::size_t i) const {
            const float fx = fractions_[i], fy = fractions_[stripCells + i], fz = fractions_[2 * stripCells + i];
            const auto along = [&](const auto& c) { return mix(mix(c.a, c.b, fy), mix(c.c, c.d, fy), fz); };
            if constexpr (sixteenAtOnce) {
                const Float16 both = along(column<Float16>(i, 0));
                return mix(firstOf(both), secondOf(both), fx);
            } else {
                return mix(along(column<Float8>(i, 0)), along(column<Float8>(i, lanes)), fx);
            }
        }
        /// Minimum and maximum of the eight cells, per quantity.
        [[gnu::always_inline]] void extrema(std::size_t i, Float8& minimum, Float8& maximum) const {
            const auto minimumOf = [](const auto& c) { return atMost(atMost(c.a, c.b), atMost(c.c, c.d)); };
            const auto maximumOf = [](const auto& c) { return atLeast(atLeast(c.a, c.b), atLeast(c.c, c.d)); };
            if constexpr (sixteenAtOnce) {
                const auto both = column<Float16>(i, 0);
                const Float16 low = minimumOf(both), high = maximumOf(both);
                minimum = atMost(firstOf(low), secondOf(low));
                maximum = atLeast(firstOf(high), secondOf(high));
            } else {
                const auto first = column<Float8>(i, 0), second = column<Float8>(i, lanes);
                minimum = atMost(minimumOf(first), minimumOf(second));
                maximum = atLeast(maximumOf(first), maximumOf(second));
            }
        }

     private:
        /// Four records of equal x: those of larger y second, of larger z last. In a Float16 each is together with its
        /// neighbour in x, which is adjacent in memory.
        template <typename Vector>
        struct Column {
            Vector a, b, c, d;
        };
        template <typename Vector>
        [[gnu::always_inline]] Column<Vector> column(std::size_t i, std::size_t from) const {
            const float* low = base_ + from + std::size_t{low_[i]};
            const float* high = ring ? base_ + from + std::size_t{high_[i]} : low + slab_;
            return {load<Vector>(low), load<Vector>(low + row_), load<Vector>(high), load<Vector>(high + row_)};
        }
        [[gnu::always_inline]] static Float8 firstOf(const Float16& both) {
            return __builtin_shufflevector(both, both, 0, 1, 2, 3, 4, 5, 6, 7);
        }
        [[gnu::always_inline]] static Float8 secondOf(const Float16& both) {
            return __builtin_shufflevector(both, both, 6, 7, 8, 9, 10, 11, 12, 13);
        }

        const float* base_;
        std::size_t row_, slab_;
        const float* fractions_;
        const std::uint32_t *low_, *high_;
    };

 private:
    /// Index of the cell before each position; stores the fraction beyond it.
    template <std::size_t axis>
    [[gnu::always_inline]] Int16 cellAlong(const Float16& place, std::size_t i) {
        const Int16 cell = atMost(__builtin_convertvector(place, Int16), Int16{} + last_[axis]);
        store(&fractions_[axis][i], place - __builtin_convertvector(cell, Float16));
        return cell;
    }
    [[gnu::always_inline]] Int16 inRing(const Int16& slab) const {
        return slab - ((slab >= view_.slabs) & view_.slabs);
    }

    RecordView view_;
    std::array<int, 3> last_;
    std::size_t row_, slab_;  ///< floats from one row or slab to the next
    int shift_ = 0;
    std::array<std::array<float, stripCells>, 3> fractions_{};  ///< of the way to the next cell, 0…1; along x, y, z
    std::array<std::uint32_t, stripCells> low_{}, high_{};
};

}  // namespace dustbench::grid_fluid::flow
