// Trilinear sampling of whole records, for a strip of cells at a time. Internal to the kernels.
//
// First the positions of all samples are computed, sixteen cells per vector; then the samples are read cell by cell,
// six quantities per vector, so that many reads are in flight at once. The paths of a cell's faces differ slightly from
// that of its centre. All quantities are read from the eight records around the centre's position, each with its own
// interpolation weights; a face that is between other records is read again separately. Frame: cells from the first
// ghost, so that a quantity of cell (i, j, k) is at (i + 1, j + 1, k + 1), whether at the cell's centre or on its face.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/lanes.h"

namespace dustbench::grid_fluid::flow {

/// Number of cells of a row processed together.
inline constexpr std::size_t stripCells = 64;

/// Positions or velocities of sixteen cells.
struct Triples {
    Float16 x, y, z;
};

/// The same for the faces of each cell across x, y and z, and for its centre.
using PlacesOfCells = std::array<Triples, 4>;

/// Within the centres of the outermost ghost cells.
[[gnu::always_inline]] inline Triples inBox(const Triples& place, const CellLayout& layout) {
    const auto within = [](const Float16& x, int cells) {
        return atMost(atLeast(x, Float16{}), everywhere<Float16>(static_cast<float>(cells + 1)));
    };
    return {within(place.x, layout.nx), within(place.y, layout.ny), within(place.z, layout.nz)};
}

/// A field in memory: whole, or as a ring of slabs, in which slab k has index k mod `slabs`.
struct RecordView {
    const float* base;
    int slabs;
};

enum class Memory : std::uint8_t { whole, ring };
enum class Reads : std::uint8_t { samples, extrema };  ///< extrema need no interpolation weights

/// A quantity on a face of cell `i` of a strip that is between other records than the centre.
struct Elsewhere {
    std::size_t i, lane;
};

/// The eight cells around each position of a strip.
template <Memory memory, Reads reads>
class CornerStrip {
    static constexpr bool ring = memory == Memory::ring;

 public:
    CornerStrip(const RecordView& view, const CellLayout& layout)
        : view_(view), last_{layout.nx, layout.ny, layout.nz}, row_(layout.row * lanes), slab_(layout.slab * lanes) {}

    /// For a ring: samples will use slabs from here on, at most as many as the ring holds.
    void lookFrom(int slab) { shift_ = slab % view_.slabs - slab; }

    /// The places of cells i to i + 15 of the strip, for i = 0, 16, 32 …; those from `cells` on are ignored. All
    /// positions must lie within the places of the outermost ghosts.
    [[gnu::always_inline]] void find(std::size_t i, const PlacesOfCells& p, std::size_t cells) {
        const Cells x = cellsAlong<0>(p[0].x, p[1].x, p[2].x, p[3].x, i);
        const Cells y = cellsAlong<1>(p[0].y, p[1].y, p[2].y, p[3].y, i);
        const Cells z = cellsAlong<2>(p[0].z, p[1].z, p[2].z, p[3].z, i);
        std::array<Int16, 4> corners;
        for (std::size_t place = 0; place < 4; ++place)
            corners[place] = findCorner(place, i, x[place], y[place], z[place]);
        constexpr Int16 laneIndices{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
        const Int16 cell = laneIndices + static_cast<int>(i);
        const Int16 counts = cell < static_cast<int>(cells);
        if (i == 0) elsewhereCount_ = 0;
        for (std::size_t lane = 0; lane < 3; ++lane)
            elsewhereCount_ += storeWhere((corners[lane] != corners[3]) & counts, 4 * cell + static_cast<int>(lane),
                                          elsewhere_.data() + elsewhereCount_);
    }

    /// Reads the samples cell by cell. Copies its data, so that they can stay in registers.
    class Reader {
     public:
        explicit Reader(const CornerStrip& strip)
            : base_(strip.view_.base),
              row_(strip.row_),
              slab_(strip.slab_),
              fractions_(strip.fractions_.data()->data()),
              low_(strip.low_.data()->data()),
              high_(strip.high_.data()->data()),
              elsewhere_(strip.elsewhere_.data()),
              elsewhereCount_(strip.elsewhereCount_) {}

        /// Six quantities at position `i`, and two meaningless values. Quantities between other records must be read
        /// again separately (forElsewhere), since a check for each cell would cost mispredicted branches.
        [[gnu::always_inline]] Float8 sample(std::size_t i) const {
            const auto along = [&](const auto& c, const auto& y, const auto& z) {
                return mixed(mixed(c.a, c.b, y), mixed(c.c, c.d, y), z);
            };
            if constexpr (sixteenAtOnce) {
                const Float16 both = along(column<Float16>(i, 0), ofTwoRecords(i, 1), ofTwoRecords(i, 2));
                return mixed(firstOf(both), secondOf(both), ofRecord(i, 0));
            } else {
                const Float8 y = ofRecord(i, 1), z = ofRecord(i, 2);
                return mixed(along(column<Float8>(i, 0), y, z), along(column<Float8>(i, lanes), y, z), ofRecord(i, 0));
            }
        }
        /// Minimum and maximum of the eight surrounding values, per quantity; except those between other records.
        [[gnu::always_inline]] void extrema(std::size_t i, Float8& minimum, Float8& maximum) const {
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
        /// Calls `take(Elsewhere)` for all quantities between other records.
        template <typename Take>
        [[gnu::always_inline]] void forElsewhere(const Take& take) const {
            for (std::size_t n = 0; n < elsewhereCount_; ++n) {
                const auto code = static_cast<std::size_t>(elsewhere_[n]);
                take(Elsewhere{code / 4, code % 4});
            }
        }
        [[gnu::always_inline]] float sample(Elsewhere e) const {
            const auto share = [&](std::size_t axis) { return fractions_[axis * fractionPitch + 4 * e.i + e.lane]; };
            const auto c = column<Float8>(e.i, e.lane, e.lane);
            const Float8 both = mix(mix(c.a, c.b, share(1)), mix(c.c, c.d, share(1)), share(2));
            return std::fma(share(0), both[lanes] - both[0], both[0]);
        }
        [[gnu::always_inline]] void extrema(Elsewhere e, float& minimum, float& maximum) const {
            const auto c = column<Float8>(e.i, e.lane, e.lane);
            const Float8 low = minimumOf(c), high = maximumOf(c);
            minimum = std::min(low[0], low[lanes]);
            maximum = std::max(high[0], high[lanes]);
        }

     private:
        /// Four records of equal x: those of larger y second, of larger z last. A Float16 contains each together with
        /// its neighbour in x, which is adjacent in memory.
        template <typename Vector>
        struct Column {
            Vector a, b, c, d;
        };
        /// From float `from` on, around the place of the centre or of a face; a face's quantity has its number.
        template <typename Vector>
        [[gnu::always_inline]] Column<Vector> column(std::size_t i, std::size_t from, std::size_t place = 3) const {
            const float* low = base_ + from + std::size_t{low_[place * stripCells + i]};
            const float* high = ring ? base_ + from + std::size_t{high_[place * stripCells + i]} : low + slab_;
            return {load<Vector>(low), load<Vector>(low + row_), load<Vector>(high), load<Vector>(high + row_)};
        }
        template <typename Vector>
        [[gnu::always_inline]] static Vector minimumOf(const Column<Vector>& c) {
            return atMost(atMost(c.a, c.b), atMost(c.c, c.d));
        }
        template <typename Vector>
        [[gnu::always_inline]] static Vector maximumOf(const Column<Vector>& c) {
            return atLeast(atLeast(c.a, c.b), atLeast(c.c, c.d));
        }
        /// The weights of a cell's faces across x, y, z and of its centre, by quantity. They are loaded at their final
        /// vector width, because widening a narrow vector would go through memory.
        [[gnu::always_inline]] Float8 ofRecord(std::size_t i, std::size_t axis) const {
            const auto f = load<Float8>(fractions_ + axis * fractionPitch + 4 * i);
            return __builtin_shufflevector(f, f, 0, 1, 2, 3, 3, 3, 3, 3);
        }
        [[gnu::always_inline]] Float16 ofTwoRecords(std::size_t i, std::size_t axis) const {
            const auto f = load<Float16>(fractions_ + axis * fractionPitch + 4 * i);
            return __builtin_shufflevector(f, f, 0, 1, 2, 3, 3, 3, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3);
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
        const int* elsewhere_;
        std::size_t elsewhereCount_;
    };

 private:
    /// Of the faces across x, y, z and of the centre.
    using Cells = std::array<Int16, 4>;

    /// Index of the cell before each position; stores the fractions beyond it, for samples.
    template <std::size_t axis>
    [[gnu::always_inline]] Cells cellsAlong(const Float16& onX, const Float16& onY, const Float16& onZ,
                                            const Float16& centre, std::size_t i) {
        const auto cellOf = [&](const Float16& place) {
            return atMost(__builtin_convertvector(place, Int16), Int16{} + last_[axis]);
        };
        const Cells cells{cellOf(onX), cellOf(onY), cellOf(onZ), cellOf(centre)};
        const auto share = [](const Float16& place, const Int16& cell) {
            return place - __builtin_convertvector(cell, Float16);
        };
        if constexpr (reads == Reads::extrema) return cells;
        storeInterleaved(&fractions_[axis][4 * i], share(onX, cells[0]), share(onY, cells[1]), share(onZ, cells[2]),
                         share(centre, cells[3]));
        return cells;
    }
    /// The record before each position on all axes, as an index of floats.
    [[gnu::always_inline]] Int16 findCorner(std::size_t place, std::size_t i, const Int16& x, const Int16& y,
                                            const Int16& z) {
        const int row = static_cast<int>(row_), slab = static_cast<int>(slab_);
        const Int16 inSlab = x * static_cast<int>(lanes) + y * row;
        const Int16 low = inSlab + (ring ? inRing(z + shift_) : z) * slab;
        store(&low_[place][i], low);
        if constexpr (ring) store(&high_[place][i], inSlab + inRing(z + (shift_ + 1)) * slab);
        return low;
    }
    /// a₀ b₀ c₀ d₀ a₁ …
    [[gnu::always_inline]] static void storeInterleaved(float* to, const Float16& a, const Float16& b, const Float16& c,
                                                        const Float16& d) {
        const auto evens = [](const Float16& p, const Float16& q) {
            return __builtin_shufflevector(p, q, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
        };
        const auto odds = [](const Float16& p, const Float16& q) {
            return __builtin_shufflevector(p, q, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
        };
        const auto lower = [](const Float16& p, const Float16& q) {
            return __builtin_shufflevector(p, q, 0, 1, 16, 17, 2, 3, 18, 19, 4, 5, 20, 21, 6, 7, 22, 23);
        };
        const auto upper = [](const Float16& p, const Float16& q) {
            return __builtin_shufflevector(p, q, 8, 9, 24, 25, 10, 11, 26, 27, 12, 13, 28, 29, 14, 15, 30, 31);
        };
        const Float16 ab = evens(a, b), cd = evens(c, d), abHigh = odds(a, b), cdHigh = odds(c, d);
        store(to, lower(ab, cd));
        store(to + 16, upper(ab, cd));
        store(to + 32, lower(abHigh, cdHigh));
        store(to + 48, upper(abHigh, cdHigh));
    }
    [[gnu::always_inline]] Int16 inRing(const Int16& slab) const {
        return slab - ((slab >= view_.slabs) & view_.slabs);
    }

    RecordView view_;
    std::array<int, 3> last_;
    std::size_t row_, slab_;  ///< floats from one row or slab to the next
    int shift_ = 0;
    /// Fractions of the way to the next cell, 0…1; along x, y, z, for the faces across x, y, z and for the centre.
    static constexpr std::size_t fractionPitch = 4 * stripCells + 16;
    alignas(64) std::array<std::array<float, fractionPitch>, 3> fractions_{};
    std::array<std::array<std::uint32_t, stripCells>, 4> low_{}, high_{};
    std::array<int, 3 * stripCells + 16> elsewhere_{};  ///< 4·cell + face
    std::size_t elsewhereCount_ = 0;
};

/// Trilinear samples of vectors of four floats in a ring of slabs, at sixteen positions.
class CentreStrip {
 public:
    CentreStrip(const float* base, int slabs, const CellLayout& layout)
        : base_(base),
          slabs_(slabs),
          last_{layout.nx, layout.ny, layout.nz},
          row_(4 * layout.row),
          slab_(4 * layout.slab) {}

    /// Samples will use slabs from here on, at most as many as the ring holds.
    void lookFrom(int slab) { shift_ = slab % slabs_ - slab; }
    [[gnu::always_inline]] void find(const Triples& place) {
        const Int16 x = cellAlong<0>(place.x), y = cellAlong<1>(place.y), z = cellAlong<2>(place.z);
        const Int16 inSlab = x * 4 + y * static_cast<int>(row_);
        store(low_.data(), inSlab + inRing(z + shift_) * static_cast<int>(slab_));
        store(high_.data(), inSlab + inRing(z + (shift_ + 1)) * static_cast<int>(slab_));
    }
    [[gnu::always_inline]] Float4 sample(std::size_t i) const {
        const float *low = base_ + low_[i], *high = base_ + high_[i];
        const float fx = fractions_[0][i], fy = fractions_[1][i], fz = fractions_[2][i];
        const Float8 both = mix(mix(load<Float8>(low), load<Float8>(low + row_), fy),
                                mix(load<Float8>(high), load<Float8>(high + row_), fy), fz);
        return mix(__builtin_shufflevector(both, both, 0, 1, 2, 3), __builtin_shufflevector(both, both, 4, 5, 6, 7),
                   fx);
    }

 private:
    template <std::size_t axis>
    [[gnu::always_inline]] Int16 cellAlong(const Float16& place) {
        const Int16 cell = atMost(__builtin_convertvector(place, Int16), Int16{} + last_[axis]);
        store(fractions_[axis].data(), place - __builtin_convertvector(cell, Float16));
        return cell;
    }
    [[gnu::always_inline]] Int16 inRing(const Int16& slab) const { return slab - ((slab >= slabs_) & slabs_); }

    const float* base_;
    int slabs_;
    std::array<int, 3> last_;
    std::size_t row_, slab_;
    int shift_ = 0;
    std::array<std::array<float, 16>, 3> fractions_{};
    std::array<std::uint32_t, 16> low_{}, high_{};
};

}  // namespace dustbench::grid_fluid::flow
