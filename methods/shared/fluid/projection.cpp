#include "methods/shared/fluid/projection.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "methods/shared/fluid/lanes.h"
#include "methods/shared/fluid/row_tiles.h"
#include "methods/shared/fluid/sixteen_records.h"
#include "methods/shared/parallel/for_each_block.h"

namespace dustbench::fluid {
namespace {

constexpr std::size_t mostCells = 4096;

/// What the faces of a row's cells conduct across y and z where no solid is in the way: 1, or 2 along an open side.
struct RowFaces {
    RowFaces(const std::uint8_t* conductance, const CellLayout& layout, int j, int k)
        : own(conductance + layout.at(0, j, k)),
          row(static_cast<std::ptrdiff_t>(layout.row)),
          slab(static_cast<std::ptrdiff_t>(layout.slab)),
          cells(static_cast<std::size_t>(layout.nx)),
          below(beyond(j == 0, -row)),
          above(beyond(j + 1 == layout.ny, row)),
          before(beyond(k == 0, -slab)),
          behind(beyond(k + 1 == layout.nz, slab)) {}

    /// Towards `step`. A wall conducts 0, so that with 1 expected nothing is plain beside it.
    [[nodiscard]] std::uint8_t beyond(bool atSide, std::ptrdiff_t step) const {
        return atSide && own[step] != 0 ? own[step] : 1;
    }
    /// True where sixteen cells are fluid and their faces conduct so, and 1 along x, the row's ends aside.
    [[nodiscard]] bool arePlain(std::size_t first) const {
        if ((first != 0 && own[first - 1] != 1) || (first + 16 < cells && own[first + 16] != 1)) return false;
        using Byte16 = std::uint8_t __attribute__((vector_size(16)));
        const auto unlike = [&](std::ptrdiff_t step, std::uint8_t expected) {
            Byte16 bytes;
            std::memcpy(&bytes, own + first + step, sizeof bytes);
            return bytes ^ expected;
        };
        const Byte16 any =
            unlike(0, 1) | unlike(-row, below) | unlike(row, above) | unlike(-slab, before) | unlike(slab, behind);
        std::array<std::uint64_t, 2> halves{};
        std::memcpy(halves.data(), &any, sizeof any);
        return (halves[0] | halves[1]) == 0;
    }

    const std::uint8_t* own;
    std::ptrdiff_t row, slab;
    std::size_t cells;
    std::uint8_t below, above, before, behind;
};

/// Over a row's cells: `sixteen(first)` or `plain(i)` where faces are plain, else `general(i)`, as at the row's ends.
template <typename Sixteen, typename Plain, typename General>
[[gnu::always_inline]] inline void forCells(const RowFaces& faces, const Sixteen& sixteen, const Plain& plain,
                                            const General& general) {
    constexpr std::size_t together = SixteenRecords::count;
    for (std::size_t i = 0; i < faces.cells; i += together) {
        const std::size_t end = std::min(i + together, faces.cells);
        if (end < i + together || !faces.arePlain(i)) {
            for (std::size_t c = i; c < end; ++c) general(c);
            continue;
        }
        if constexpr (sixteenAtOnce)
            sixteen(i);
        else
            for (std::size_t c = i; c < end; ++c) plain(c);
    }
}

float divergenceOf(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, std::size_t at) {
    const auto row = static_cast<std::ptrdiff_t>(layout.row), slab = static_cast<std::ptrdiff_t>(layout.slab);
    return (faceSpeed(cells, conductance, at, 1, 0) - faceSpeed(cells, conductance, at, -1, 0)) +
           (faceSpeed(cells, conductance, at, row, 1) - faceSpeed(cells, conductance, at, -row, 1)) +
           (faceSpeed(cells, conductance, at, slab, 2) - faceSpeed(cells, conductance, at, -slab, 2));
}

/// Weights and pressures around one cell.
struct Cell {
    std::size_t at;
    int i, j, k;
};

/// What the two faces of a cell along an axis change by, −h·∇q.
struct FaceChanges {
    float before, behind;
};

FaceChanges changes(const PoissonLevel& level, const std::uint8_t* conductance, const Cell& cell, int axis,
                    std::ptrdiff_t step) {
    const auto q = [&](int offset) {
        return level.pressure.cell(level.layout, cell.i + (axis == 0 ? offset : 0), cell.j + (axis == 1 ? offset : 0),
                                   cell.k + (axis == 2 ? offset : 0));
    };
    const auto weight = [&](std::ptrdiff_t to) {
        return static_cast<float>(conductance[static_cast<std::ptrdiff_t>(cell.at) + to]);
    };
    return {weight(-step) * (q(-1) - q(0)), weight(step) * (q(0) - q(1))};
}

}  // namespace

float faceSpeed(const CellField& cells, const std::uint8_t* conductance, std::size_t at, std::ptrdiff_t step,
                std::size_t axis) {
    const float own = cells.cell(at)[axis];
    const float other = *(cells.cell(at) + step * static_cast<std::ptrdiff_t>(lanes) + axis);
    return conductance[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + step)] == 0 ? other
                                                                                              : 0.5f * (own + other);
}

void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const SplitLayout& to = finest.layout;
    using Sums = std::array<float, mostCells + 1>;
    forRowsInTiles<Sums>(layout, [&](int j, int k, Sums& sums) {
        const std::size_t at = layout.at(0, j, k);
        const RowFaces faces(conductance, layout, j, k);
        const float* x = cells.cell(at);
        const float* below = cells.cell(at - layout.row);
        const float* above = cells.cell(at + layout.row);
        const float* before = cells.cell(at - layout.slab);
        const float* behind = cells.cell(at + layout.slab);
        const auto general = [&](std::size_t i) {
            sums[i] = faces.own[i] == 1 ? divergenceOf(cells, layout, conductance, at + i) : 0.0f;
        };
        forCells(
            faces,
            [&](std::size_t i) {
                const auto along = [i](const float* ahead, const float* back) {
                    return SixteenRecords(ahead + i * lanes) - SixteenRecords(back + i * lanes);
                };
                store(&sums[i], 0.5f * (along(x + lanes, x - lanes).get<0>() + along(above, below).get<1>() +
                                        along(behind, before).get<2>()));
            },
            [&](std::size_t i) {
                const auto along = [i](const float* ahead, const float* back, std::size_t axis) {
                    return ahead[i * lanes + axis] - back[i * lanes + axis];
                };
                sums[i] = 0.5f * (along(x + lanes, x - lanes, 0) + along(above, below, 1) + along(behind, before, 2));
            },
            general);
        general(0);
        general(nx - 1);
        sums[nx] = 0;
        const int colour = (j + k) & 1;
        float* even = finest.rightSide.colour[colour] + to.at(j, k);
        float* odd = finest.rightSide.colour[1 - colour] + to.at(j, k);
        for (std::size_t m = 0; m < to.half; ++m) {
            even[m] = sums[2 * m];
            odd[m] = sums[2 * m + 1];
        }
    });
}

void Projection::subtractGradient(CellField& cells, const CellLayout& layout, const SolidCells& solids,
                                  const PoissonLevel& finest) {
    const std::uint8_t* conductance = solids.conductance();
    const auto row = static_cast<std::ptrdiff_t>(layout.row), slab = static_cast<std::ptrdiff_t>(layout.slab);
    const std::array<std::ptrdiff_t, 3> steps{1, row, slab};
    const auto cellAt = [&](std::size_t at) {
        const std::size_t inSlab = at % layout.slab;
        return Cell{at, static_cast<int>(inSlab % layout.row) - 1, static_cast<int>(inSlab / layout.row) - 1,
                    static_cast<int>(at / layout.slab) - 1};
    };
    // Beside blocked faces first, while their neighbours still have the speeds of before.
    const auto beside = solids.besideBlocked();
    besideBlocked_.resize(beside.size());
    parallel::forEachBlock(beside.size(), 2048, [&](std::size_t first, std::size_t count) {
        for (std::size_t b = first; b < first + count; ++b) {
            const Cell cell = cellAt(beside[b]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::ptrdiff_t step = steps[axis];
                const FaceChanges change = changes(finest, conductance, cell, static_cast<int>(axis), step);
                const auto at = static_cast<std::ptrdiff_t>(cell.at);
                const bool blocked = conductance[at - step] == 0 || conductance[at + step] == 0;
                const float speeds = blocked ? 0.5f * (faceSpeed(cells, conductance, cell.at, -step, axis) +
                                                       faceSpeed(cells, conductance, cell.at, step, axis))
                                             : cells.cell(cell.at)[axis];
                besideBlocked_[b][static_cast<int>(axis)] = speeds + 0.5f * (change.before + change.behind);
            }
        }
    });
    const SplitLayout& in = finest.layout;
    const auto nx = static_cast<std::size_t>(layout.nx);
    struct Gradient {
        std::array<float, mostCells + 1> x, y, z;
    };
    forRowsInTiles<Gradient>(layout, [&](int j, int k, Gradient& gradient) {
        auto& [x, y, z] = gradient;
        const std::size_t at = layout.at(0, j, k);
        float* record = cells.cell(at);
        const RowFaces faces(conductance, layout, j, k);
        const auto general = [&](std::size_t i) {
            if (faces.own[i] != 1) return;
            const Cell cell{at + i, static_cast<int>(i), j, k};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const FaceChanges change = changes(finest, conductance, cell, static_cast<int>(axis), steps[axis]);
                record[i * lanes + axis] += 0.5f * (change.before + change.behind);
            }
        };
        // Both neighbours of an even cell along any axis are in the halves of the other colour, and the reverse.
        const int colour = (j + k) & 1;
        const float* even = finest.pressure.colour[colour] + in.at(j, k);
        const float* odd = finest.pressure.colour[1 - colour] + in.at(j, k);
#pragma GCC ivdep
        for (std::size_t m = 0; m < in.half; ++m) {
            x[2 * m] = 0.5f * ((odd - 1)[m] - odd[m]);
            x[2 * m + 1] = 0.5f * (even[m] - (even + 1)[m]);
        }
        const auto across = [&](std::array<float, mostCells + 1>& change, std::size_t step, float before,
                                float behind) {
            if (before == 1 && behind == 1) {
#pragma GCC ivdep
                for (std::size_t m = 0; m < in.half; ++m) {
                    change[2 * m] = 0.5f * ((odd - step)[m] - (odd + step)[m]);
                    change[2 * m + 1] = 0.5f * ((even - step)[m] - (even + step)[m]);
                }
                return;
            }
#pragma GCC ivdep
            for (std::size_t m = 0; m < in.half; ++m) {
                change[2 * m] = 0.5f * (before * ((odd - step)[m] - even[m]) + behind * (even[m] - (odd + step)[m]));
                change[2 * m + 1] =
                    0.5f * (before * ((even - step)[m] - odd[m]) + behind * (odd[m] - (even + step)[m]));
            }
        };
        across(y, in.row, faces.below, faces.above);
        across(z, in.slab, faces.before, faces.behind);
        x[0] = y[0] = z[0] = x[nx - 1] = y[nx - 1] = z[nx - 1] = 0;
        forCells(
            faces,
            [&](std::size_t i) {
                const SixteenRecords change({load<Float16>(&x[i]), load<Float16>(&y[i]), load<Float16>(&z[i])});
                (SixteenRecords(record + i * lanes) + change).storeTo(record + i * lanes);
            },
            [&](std::size_t i) {
                record[i * lanes] += x[i];
                record[i * lanes + 1] += y[i];
                record[i * lanes + 2] += z[i];
            },
            [&](std::size_t i) {
                if (i != 0 && i + 1 != nx) general(i);
            });
        general(0);
        general(nx - 1);
    });
    for (std::size_t b = 0; b < beside.size(); ++b)
        for (int axis = 0; axis < 3; ++axis) cells.cell(beside[b])[axis] = besideBlocked_[b][axis];
}

}  // namespace dustbench::fluid
