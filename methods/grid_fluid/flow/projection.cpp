#include "methods/grid_fluid/flow/projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <mutex>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// Iterates over rows in tiles, so that adjacent rows in y and z are still cached when their neighbours are processed.
/// Calls `row(j, k, scratch)` for every row of a box; the rows of a tile share one `Scratch`, initially `Scratch{}`,
/// and `done(scratch)` follows its last.
template <typename Scratch, typename Row, typename Done>
void forRowsInTiles(const CellLayout& layout, const Row& row, const Done& done) {
    constexpr int side = 16;  // for rows of 256 cells, three slabs of a tile are a third of a megabyte
    const int tilesJ = (layout.ny + side - 1) / side, tilesK = (layout.nz + side - 1) / side;
    const auto tiles = static_cast<std::size_t>(tilesJ) * static_cast<std::size_t>(tilesK);
    parallel::forEachBlock(tiles, 1, [&](std::size_t tile, std::size_t) {
        const int firstJ = static_cast<int>(tile) % tilesJ * side, firstK = static_cast<int>(tile) / tilesJ * side;
        Scratch scratch{};
        for (int k = firstK; k < std::min(firstK + side, layout.nz); ++k)
            for (int j = firstJ; j < std::min(firstJ + side, layout.ny); ++j) row(j, k, scratch);
        done(scratch);
    });
}

template <typename Scratch, typename Row>
void forRowsInTiles(const CellLayout& layout, const Row& row) {
    forRowsInTiles<Scratch>(layout, row, [](const Scratch&) {});
}

constexpr std::size_t maximumProjectedCells = 4096;
/// One number per cell of a row, and one more if the number of cells is odd.
using Row = std::array<float, maximumProjectedCells + 1>;

/// h·∇·u of a row's cells: the sum over the axes of the speed of the next face minus that of the previous face.
void divergenceOfRow(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, int j, int k,
                     Row& sums) {
    const std::size_t at = layout.at(0, j, k);
    const float *own = cells.cell(at), *above = cells.cell(at + layout.row), *behind = cells.cell(at + layout.slab);
    forCells(
        conductance + at, static_cast<std::size_t>(layout.nx),
        [&](std::size_t i) {
            const SixteenRecords centre(own + i * lanes);
            store(&sums[i], (SixteenRecords(own + (i + 1) * lanes) - centre).get<0>() +
                                (SixteenRecords(above + i * lanes) - centre).get<1>() +
                                (SixteenRecords(behind + i * lanes) - centre).get<2>());
        },
        [&](std::size_t i) {
            const float* centre = own + i * lanes;
            sums[i] = conductance[at + i] != 1 ? 0.0f
                                               : (centre[lanes] - centre[0]) + ((above + i * lanes)[1] - centre[1]) +
                                                     ((behind + i * lanes)[2] - centre[2]);
        });
}

/// The pressures of a row. All neighbours of an even cell are odd cells, and vice versa.
struct RowPressures {
    RowPressures(const PoissonLevel& level, int j, int k)
        : even(level.pressure.colour[(j + k) & 1] + level.layout.at(j, k)),
          odd(level.pressure.colour[1 - ((j + k) & 1)] + level.layout.at(j, k)),
          half(level.layout.half) {}

    const float *even, *odd;
    std::size_t half;
};

/// −h·∇q on the previous faces of a row's cells.
struct RowChanges {
    Row x, y, z;
};

/// q₋ − q along x.
void changeAlong(const RowPressures q, Row& change) {
    const float *even = q.even, *odd = q.odd;
#pragma GCC ivdep
    for (std::size_t m = 0; m < q.half; ++m) {
        change[2 * m] = (odd - 1)[m] - even[m];
        change[2 * m + 1] = even[m] - odd[m];
    }
}

/// The same with the previous neighbours at distance `step`.
void changeAcross(const RowPressures q, std::size_t step, Row& change) {
    const float *even = q.even, *odd = q.odd;
#pragma GCC ivdep
    for (std::size_t m = 0; m < q.half; ++m) {
        change[2 * m] = (odd - step)[m] - even[m];
        change[2 * m + 1] = (even - step)[m] - odd[m];
    }
}

/// The weight of the face between two cells: 1 in fluid, 2 at an open side, where q is 0 half a cell away.
float weightOf(std::uint8_t before, std::uint8_t own) {
    return before == 0 || own == 0 ? 0.0f : static_cast<float>(std::max(before, own));
}

/// Whether sixteen cells and their previous neighbours on every axis are fluid.
bool allConduct(const std::uint8_t* own, std::size_t row, std::size_t slab) {
    using Byte16 = std::uint8_t __attribute__((vector_size(16)));
    const auto unlike = [&](const std::uint8_t* from) {
        Byte16 bytes;
        std::memcpy(&bytes, from, sizeof bytes);
        return bytes ^ 1;
    };
    const Byte16 any = unlike(own) | unlike(own - 1) | unlike(own - row) | unlike(own - slab);
    std::array<std::uint64_t, 2> halves{};
    std::memcpy(halves.data(), &any, sizeof any);
    return (halves[0] | halves[1]) == 0;
}

/// The faces on the far sides, whose records are ghosts; q is 0 beyond an open side.
void subtractBeyond(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                    const PoissonLevel& finest) {
    const glm::ivec3 size(layout.nx, layout.ny, layout.nz);
    const std::array<std::size_t, 3> steps{1, layout.row, layout.slab};
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        glm::ivec3 beyond(0);
        beyond[axis] = size[axis];
        for (beyond[c] = 0; beyond[c] < size[c]; ++beyond[c])
            for (beyond[b] = 0; beyond[b] < size[b]; ++beyond[b]) {
                const std::size_t at = layout.at(beyond.x, beyond.y, beyond.z);
                const auto a = static_cast<std::size_t>(axis);
                const float weight = weightOf(conductance[at - steps[a]], conductance[at]);
                if (weight == 0) continue;
                glm::ivec3 inner = beyond;
                inner[axis] -= 1;
                cells.cell(at)[a] += weight * finest.pressure.cell(finest.layout, inner.x, inner.y, inner.z);
            }
    }
}

}  // namespace

void gatherDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      PoissonLevel& finest) {
    const SplitLayout& to = finest.layout;
    forRowsInTiles<Row>(layout, [&](int j, int k, Row& sums) {
        divergenceOfRow(cells, layout, conductance, j, k, sums);
        sums[static_cast<std::size_t>(layout.nx)] = 0;
        const int colour = (j + k) & 1;
        float* even = finest.rightSide.colour[colour] + to.at(j, k);
        float* odd = finest.rightSide.colour[1 - colour] + to.at(j, k);
        for (std::size_t m = 0; m < to.half; ++m) {
            even[m] = sums[2 * m];
            odd[m] = sums[2 * m + 1];
        }
    });
}

FieldSurvey subtractGradient(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                             const PoissonLevel& finest) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    struct OfTile {
        RowChanges changes;
        FieldSurvey survey;
    };
    std::mutex mutex;
    FieldSurvey survey;
    const auto ofRow = [&](int j, int k, OfTile& tile) {
        RowChanges& changes = tile.changes;
        const RowPressures q(finest, j, k);
        changeAlong(q, changes.x);
        changeAcross(q, finest.layout.row, changes.y);
        changeAcross(q, finest.layout.slab, changes.z);
        const std::size_t at = layout.at(0, j, k);
        const std::uint8_t* own = conductance + at;
        float* record = cells.cell(at);
        const auto one = [&](std::size_t i) {
            record[i * lanes] += weightOf(own[static_cast<std::ptrdiff_t>(i) - 1], own[i]) * changes.x[i];
            record[i * lanes + 1] += weightOf((own - layout.row)[i], own[i]) * changes.y[i];
            record[i * lanes + 2] += weightOf((own - layout.slab)[i], own[i]) * changes.z[i];
        };
        for (std::size_t i = 0; i < nx; i += SixteenRecords::count) {
            const std::size_t end = std::min(i + SixteenRecords::count, nx);
            if (sixteenAtOnce && end == i + SixteenRecords::count && allConduct(own + i, layout.row, layout.slab)) {
                const SixteenRecords change(
                    {load<Float16>(&changes.x[i]), load<Float16>(&changes.y[i]), load<Float16>(&changes.z[i])});
                (SixteenRecords(record + i * lanes) + change).storeTo(record + i * lanes);
            } else {
                for (std::size_t c = i; c < end; ++c) one(c);
            }
        }
        tile.survey.look(record, nx);
    };
    forRowsInTiles<OfTile>(layout, ofRow, [&](const OfTile& tile) {
        const std::scoped_lock lock(mutex);
        survey.add(tile.survey);
    });
    subtractBeyond(cells, layout, conductance, finest);
    return survey;
}

float maximumDivergence(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance) {
    std::mutex mutex;
    float maximum = 0;
    forRowsInTiles<Row>(layout, [&](int j, int k, Row& sums) {
        divergenceOfRow(cells, layout, conductance, j, k, sums);
        float ofRow = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(layout.nx); ++i)
            ofRow = std::max(ofRow, std::fabs(sums[i]));
        const std::scoped_lock lock(mutex);
        maximum = std::max(maximum, ofRow);
    });
    return maximum;
}

}  // namespace dustbench::grid_fluid::flow
