#include "methods/grid_fluid/flow/projection.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/row_tiles.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::size_t maximumCells = 4096;

/// Conductances of the faces of a row's cells across y and z if there is no solid: 1, or 2 at an open side.
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

    /// Conductance towards `step`. For a wall, which conducts 0, the expected value stays 1, so no cell next to it is
    /// plain.
    [[nodiscard]] std::uint8_t beyond(bool atSide, std::ptrdiff_t step) const {
        return atSide && own[step] != 0 ? own[step] : 1;
    }
    /// Whether sixteen cells are fluid and plain: their faces across y and z conduct as expected, those along x conduct
    /// 1, apart from the ends of the row.
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

/// Visits a row's cells: `sixteen(first)` or `plain(i)` if their faces are plain, otherwise and at the row's end
/// `general(i)`.
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

/// The speed of the face between a cell of fluid and the next one towards `step` (in padded cells), before projection.
float faceSpeed(const CellField& cells, const std::uint8_t* conductance, std::size_t at, std::ptrdiff_t step,
                std::size_t axis) {
    const float own = cells.cell(at)[axis];
    const float other = *(cells.cell(at) + step * static_cast<std::ptrdiff_t>(lanes) + axis);
    return conductance[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at) + step)] == 0 ? other
                                                                                              : 0.5f * (own + other);
}

float divergenceOf(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, std::size_t at) {
    const auto row = static_cast<std::ptrdiff_t>(layout.row), slab = static_cast<std::ptrdiff_t>(layout.slab);
    return (faceSpeed(cells, conductance, at, 1, 0) - faceSpeed(cells, conductance, at, -1, 0)) +
           (faceSpeed(cells, conductance, at, row, 1) - faceSpeed(cells, conductance, at, -row, 1)) +
           (faceSpeed(cells, conductance, at, slab, 2) - faceSpeed(cells, conductance, at, -slab, 2));
}

struct Cell {
    std::size_t at;
    int i, j, k;
};

Cell cellAt(const CellLayout& layout, std::size_t at) {
    const std::size_t inSlab = at % layout.slab;
    return {at, static_cast<int>(inSlab % layout.row) - 1, static_cast<int>(inSlab / layout.row) - 1,
            static_cast<int>(at / layout.slab) - 1};
}

/// Cells of any kind, one at a time.
struct Gradient {
    Gradient(const CellLayout& layout, const std::uint8_t* conducts, const PoissonLevel& finest)
        : level(finest),
          conductance(conducts),
          steps{1, static_cast<std::ptrdiff_t>(layout.row), static_cast<std::ptrdiff_t>(layout.slab)} {}

    /// −h·∇q along an axis: the mean of the changes of the cell's two faces.
    [[nodiscard]] float change(const Cell& cell, std::size_t axis) const {
        const auto q = [&](int offset) {
            return level.pressure.cell(level.layout, cell.i + (axis == 0 ? offset : 0),
                                       cell.j + (axis == 1 ? offset : 0), cell.k + (axis == 2 ? offset : 0));
        };
        const auto weight = [&](std::ptrdiff_t to) {
            return static_cast<float>(conductance[static_cast<std::ptrdiff_t>(cell.at) + to]);
        };
        const float before = weight(-steps[axis]) * (q(-1) - q(0)), behind = weight(steps[axis]) * (q(0) - q(1));
        return 0.5f * (before + behind);
    }
    /// If a face across an axis is blocked, the mean of the two face speeds replaces the cell's own.
    [[nodiscard]] float speed(const CellField& cells, std::size_t at, std::size_t axis) const {
        const std::ptrdiff_t own = static_cast<std::ptrdiff_t>(at), step = steps[axis];
        if (conductance[own - step] != 0 && conductance[own + step] != 0) return cells.cell(at)[axis];
        return 0.5f * (faceSpeed(cells, conductance, at, -step, axis) + faceSpeed(cells, conductance, at, step, axis));
    }

    const PoissonLevel& level;
    const std::uint8_t* conductance;
    std::array<std::ptrdiff_t, 3> steps;
};

/// One number per cell of a row, and one more if the number of cells is odd.
using Row = std::array<float, maximumCells + 1>;
/// −h·∇q of a row's plain cells.
struct RowChanges {
    Row x, y, z;
};

/// The pressures of a row. All neighbours of an even cell are odd cells, and vice versa.
struct RowPressures {
    RowPressures(const PoissonLevel& level, int j, int k)
        : even(level.pressure.colour[(j + k) & 1] + level.layout.at(j, k)),
          odd(level.pressure.colour[1 - ((j + k) & 1)] + level.layout.at(j, k)),
          half(level.layout.half) {}

    const float *even, *odd;
    std::size_t half;
};

/// ½(q₋ − q₊)
void changeAlong(const RowPressures q, Row& change) {
    const float *even = q.even, *odd = q.odd;
#pragma GCC ivdep
    for (std::size_t m = 0; m < q.half; ++m) {
        change[2 * m] = 0.5f * ((odd - 1)[m] - odd[m]);
        change[2 * m + 1] = 0.5f * (even[m] - (even + 1)[m]);
    }
}

/// ½(w₋·(q₋ − q) + w₊·(q − q₊)), with neighbours at distance `step`; if both conduct 1, q cancels.
void changeAcross(const RowPressures q, std::size_t step, float before, float behind, Row& change) {
    const float *even = q.even, *odd = q.odd;
    if (before == 1 && behind == 1) {
#pragma GCC ivdep
        for (std::size_t m = 0; m < q.half; ++m) {
            change[2 * m] = 0.5f * ((odd - step)[m] - (odd + step)[m]);
            change[2 * m + 1] = 0.5f * ((even - step)[m] - (even + step)[m]);
        }
        return;
    }
#pragma GCC ivdep
    for (std::size_t m = 0; m < q.half; ++m) {
        change[2 * m] = 0.5f * (before * ((odd - step)[m] - even[m]) + behind * (even[m] - (odd + step)[m]));
        change[2 * m + 1] = 0.5f * (before * ((even - step)[m] - odd[m]) + behind * (odd[m] - (even + step)[m]));
    }
}

/// Applies u += change to a row: plain cells from `changes`, all others by `general(i)`.
template <typename General>
void addChanges(const RowFaces& faces, RowChanges& changes, float* record, const General& general) {
    auto& [x, y, z] = changes;
    const std::size_t last = faces.cells - 1;
    x[0] = y[0] = z[0] = x[last] = y[last] = z[last] = 0;
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
            if (i != 0 && i != last) general(i);
        });
    general(0);
    general(last);
}

}  // namespace

void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const SplitLayout& to = finest.layout;
    using Sums = std::array<float, maximumCells + 1>;
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

void Projection::findBesideBlocked(const CellField& cells, const CellLayout& layout, const SolidCells& solids,
                                   const PoissonLevel& finest) {
    const Gradient gradient(layout, solids.conductance(), finest);
    const auto beside = solids.besideBlocked();
    besideBlocked_.resize(beside.size());
    parallel::forEachBlock(beside.size(), 2048, [&](std::size_t first, std::size_t count) {
        for (std::size_t b = first; b < first + count; ++b) {
            const Cell cell = cellAt(layout, beside[b]);
            for (std::size_t axis = 0; axis < 3; ++axis)
                besideBlocked_[b][static_cast<int>(axis)] =
                    gradient.speed(cells, cell.at, axis) + gradient.change(cell, axis);
        }
    });
}

void Projection::subtractGradient(CellField& cells, const CellLayout& layout, const SolidCells& solids,
                                  const PoissonLevel& finest) {
    // First, while the neighbours still have their old velocities.
    findBesideBlocked(cells, layout, solids, finest);
    const Gradient gradient(layout, solids.conductance(), finest);
    forRowsInTiles<RowChanges>(layout, [&](int j, int k, RowChanges& changes) {
        const RowFaces faces(solids.conductance(), layout, j, k);
        const RowPressures q(finest, j, k);
        changeAlong(q, changes.x);
        changeAcross(q, finest.layout.row, faces.below, faces.above, changes.y);
        changeAcross(q, finest.layout.slab, faces.before, faces.behind, changes.z);
        const std::size_t at = layout.at(0, j, k);
        float* record = cells.cell(at);
        addChanges(faces, changes, record, [&](std::size_t i) {
            if (faces.own[i] != 1) return;
            for (std::size_t axis = 0; axis < 3; ++axis)
                record[i * lanes + axis] += gradient.change({at + i, static_cast<int>(i), j, k}, axis);
        });
    });
    const auto beside = solids.besideBlocked();
    for (std::size_t b = 0; b < beside.size(); ++b)
        for (int axis = 0; axis < 3; ++axis) cells.cell(beside[b])[axis] = besideBlocked_[b][axis];
}

}  // namespace dustbench::grid_fluid::flow
