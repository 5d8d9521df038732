#include "methods/grid_fluid/flow/forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/row_tiles.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/parallel/for_stages.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::size_t diffusedRows = 32;
constexpr std::size_t maximumForcedCells = 4096;
/// Smaller values are set to 0: otherwise fading smoke becomes denormal numbers, which are slow.
constexpr float nothing = 1e-18f;

struct Curl {
    Curl(const CellLayout& layout, std::span<float> memory)
        : count(layout.rows() * static_cast<std::size_t>(layout.nx)),
          x(memory.data()),
          y(x + count),
          z(y + count),
          length(z + count),
          lift(length + count) {}
    std::size_t count;
    float *x, *y, *z, *length;
    float* lift;  ///< of the forces, once they replace the curl: what does not turn the air
};

/// ω at the centres of a row: central differences of the speeds there, each the mean of two faces; and |ω|.
void curlOfRow(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float spacingMetres,
               int j, int k, const Curl& curl) {
    const float perFourCells = 0.25f / spacingMetres;
    const auto nx = static_cast<std::size_t>(layout.nx);
    const std::size_t row = layout.row * lanes, slab = layout.slab * lanes;
    const std::size_t at = layout.at(0, j, k);
    const std::size_t r =
        static_cast<std::size_t>(k) * static_cast<std::size_t>(layout.ny) + static_cast<std::size_t>(j);
    const float* own = cells.cell(at);
    float *x = curl.x + r * nx, *y = curl.y + r * nx, *z = curl.z + r * nx, *length = curl.length + r * nx;
    const auto cell = [&](std::size_t i) {
        const float fluid = conductance[at + i] == 1 ? perFourCells : 0.0f;
        const float* record = own + i * lanes;
        // Of lane u between the neighbours a step ahead and behind; `half` leads to its other face.
        const auto along = [record](std::size_t step, std::size_t half, std::size_t u) {
            const auto forth = static_cast<std::ptrdiff_t>(step);
            return (record[forth + static_cast<std::ptrdiff_t>(u)] +
                    (record + half)[forth + static_cast<std::ptrdiff_t>(u)]) -
                   (record[static_cast<std::ptrdiff_t>(u) - forth] +
                    (record + half)[static_cast<std::ptrdiff_t>(u) - forth]);
        };
        x[i] = (along(row, slab, 2) - along(slab, row, 1)) * fluid;
        y[i] = (along(slab, lanes, 0) - along(lanes, slab, 2)) * fluid;
        z[i] = (along(lanes, row, 1) - along(row, lanes, 0)) * fluid;
    };
    const auto sixteenCells = [&](std::size_t i) {
        const float* records = own + i * lanes;
        const auto between = [records](std::size_t step, std::size_t half) {
            return (SixteenRecords(records + step) + SixteenRecords(records + half + step)) -
                   (SixteenRecords(records - step) + SixteenRecords(records + half - step));
        };
        store(x + i, (between(row, slab).get<2>() - between(slab, row).get<1>()) * perFourCells);
        store(y + i, (between(slab, lanes).get<0>() - between(lanes, slab).get<2>()) * perFourCells);
        store(z + i, (between(lanes, row).get<1>() - between(row, lanes).get<0>()) * perFourCells);
    };
    forCells(conductance + at, nx, sixteenCells, cell);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) length[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
}

/// f = ε·h·(N × ω), N = ∇|ω| / |∇|ω||, in place of ω. Beyond the box |ω| is extended.
void confineRow(const Curl& curl, const CellLayout& layout, int j, int k, float strength) {
    const auto nx = static_cast<std::size_t>(layout.nx), slab = nx * static_cast<std::size_t>(layout.ny);
    const std::size_t at = static_cast<std::size_t>(k) * slab + static_cast<std::size_t>(j) * nx;
    const float* own = curl.length + at;
    const float* below = j > 0 ? own - nx : own;
    const float* above = j + 1 < layout.ny ? own + nx : own;
    const float* before = k > 0 ? own - slab : own;
    const float* behind = k + 1 < layout.nz ? own + slab : own;
    float *wx = curl.x + at, *wy = curl.y + at, *wz = curl.z + at;
    const auto cell = [&](std::size_t i, float left, float right) {
        const float gx = right - left, gy = above[i] - below[i], gz = behind[i] - before[i];
        const float scale = strength / std::sqrt(gx * gx + gy * gy + gz * gz + 1e-20f);
        const float x = wx[i], y = wy[i], z = wz[i];
        wx[i] = scale * (gy * z - gz * y);
        wy[i] = scale * (gz * x - gx * z);
        wz[i] = scale * (gx * y - gy * x);
    };
#pragma GCC ivdep
    for (std::size_t i = 1; i + 1 < nx; ++i) cell(i, own[i - 1], own[i + 1]);
    cell(0, own[0], own[1]);
    cell(nx - 1, own[nx - 2], own[nx - 1]);
}

/// What is added to the faces of a row's cells, in m/s.
struct AddedRow {
    std::array<float, maximumForcedCells> x, y, z;
    std::array<float, maximumForcedCells + 3> sum;  ///< over rows; see sumOfRows
};

/// Buoyancy and weight at the centres; solids hold neither heat nor density.
void findLift(const CellField& cells, const CellLayout& layout, int j, int k, float lift, float weight, float* force) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    float* to =
        force + (static_cast<std::size_t>(k) * static_cast<std::size_t>(layout.ny) + static_cast<std::size_t>(j)) * nx;
    const float* record = cells.cell(layout.at(0, j, k));
    for (std::size_t i = 0; i < nx; ++i, record += lanes) to[i] = lift * record[temperature] - weight * record[density];
}

/// Shares of the cells around a cell, (1, 2, 1)/4, and around the face towards its neighbour before it: the mean of the
/// shares around both.
constexpr std::array<float, 3> aroundCell{0.25f, 0.5f, 0.25f};
constexpr std::array<float, 4> aroundFace{0.125f, 0.375f, 0.375f, 0.125f};  // from two cells before to one behind

/// The sum over rows around row (j, k) with these shares along y and z; beyond the box its outermost rows again. `sum`
/// has room for two cells before the row and one behind it.
template <std::size_t ofY, std::size_t ofZ>
void sumOfRows(const float* field, const CellLayout& layout, int j, int k, const std::array<float, ofY>& sharesY,
               const std::array<float, ofZ>& sharesZ, float* sum) {
    const auto nx = static_cast<std::size_t>(layout.nx), ny = static_cast<std::size_t>(layout.ny);
    const auto rowAt = [&](std::size_t b, std::size_t c) {
        const int y = std::clamp(j + static_cast<int>(b) - static_cast<int>(ofY) + 2, 0, layout.ny - 1);
        const int z = std::clamp(k + static_cast<int>(c) - static_cast<int>(ofZ) + 2, 0, layout.nz - 1);
        return field + (static_cast<std::size_t>(z) * ny + static_cast<std::size_t>(y)) * nx;
    };
    std::array<const float*, ofY * ofZ> rows;
    std::array<float, ofY * ofZ> shares;
    for (std::size_t c = 0; c < ofZ; ++c)
        for (std::size_t b = 0; b < ofY; ++b) {
            rows[c * ofY + b] = rowAt(b, c);
            shares[c * ofY + b] = sharesY[b] * sharesZ[c];
        }
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) {
        float total = 0;
        for (std::size_t r = 0; r < rows.size(); ++r) total += shares[r] * rows[r][i];
        sum[i] = total;
    }
    sum[-2] = sum[-1] = sum[0];
    sum[nx] = sum[nx - 1];
}

/// A face has the mean force of its two cells. That of confinement is spread beforehand over the cells around each, by
/// (1, 2, 1)/4 along each axis: N turns from cell to cell where |ω| varies little, and so would the force.
void facesOfRow(const Curl& force, const CellLayout& layout, int j, int k, bool confined, AddedRow& row) {
    const auto nx = static_cast<std::size_t>(layout.nx), slab = nx * static_cast<std::size_t>(layout.ny);
    const float* lift = force.lift + static_cast<std::size_t>(k) * slab + static_cast<std::size_t>(j) * nx;
    const float* liftBelow = j > 0 ? lift - nx : lift;
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) row.y[i] = 0.5f * (liftBelow[i] + lift[i]);
    if (!confined) {
        std::fill_n(row.x.begin(), nx, 0.0f);
        std::fill_n(row.z.begin(), nx, 0.0f);
        return;
    }
    float* sum = row.sum.data() + 2;
    sumOfRows(force.x, layout, j, k, aroundCell, aroundCell, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) {
        const float* s = sum + i;
        row.x[i] = aroundFace[0] * s[-2] + aroundFace[1] * s[-1] + aroundFace[2] * s[0] + aroundFace[3] * s[1];
    }
    const auto spreadAlongX = [&](std::size_t i) {
        const float* s = sum + i;
        return aroundCell[0] * s[-1] + aroundCell[1] * s[0] + aroundCell[2] * s[1];
    };
    sumOfRows(force.y, layout, j, k, aroundFace, aroundCell, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) row.y[i] += spreadAlongX(i);
    sumOfRows(force.z, layout, j, k, aroundCell, aroundFace, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) row.z[i] = spreadAlongX(i);
}

float orNothing(float value) {
    return value > nothing || value < -nothing ? value : 0.0f;
}

/// `sixteenCells(first)` where everything of sixteen cells moves, otherwise `cell(i)` one by one.
template <typename SixteenCells, typename Cell>
void forMoving(const Moving* moving, std::size_t cells, const SixteenCells& sixteenCells, const Cell& cell) {
    for (std::size_t i = 0; i < cells; i += SixteenRecords::count) {
        const std::size_t end = std::min(i + SixteenRecords::count, cells);
        const bool allOfThem = sixteenAtOnce && end == i + SixteenRecords::count &&
                               std::all_of(moving + i, moving + end, [](Moving m) { return m == allMoves; });
        if (allOfThem)
            sixteenCells(i);
        else
            for (std::size_t c = i; c < end; ++c) cell(c);
    }
}

/// What a step changes in the cells of a row: forces on the faces, and decay at the centres.
class Change {
 public:
    Change(const ForceSettings& settings, float stepSeconds)
        : keptDensity_(std::exp(-settings.densityDecayPerSecond * stepSeconds)),
          keptHeat_(std::exp(-settings.coolingPerSecond * stepSeconds)),
          lost_(settings.reactionLossPerSecond * stepSeconds) {}

    void row(CellField& cells, const CellLayout& layout, const Moving* moving, int j, int k,
             const AddedRow& force) const {
        const std::size_t at = layout.at(0, j, k);
        float* records = cells.cell(at);
        const auto cell = [&](std::size_t i) {
            float* record = records + i * lanes;
            const std::array<float, 3> added{force.x[i], force.y[i], force.z[i]};
            for (std::size_t axis = 0; axis < 3; ++axis)
                if ((moving[at + i] >> axis & 1) != 0) record[axis] = orNothing(record[axis] + added[axis]);
            if ((moving[at + i] & 8) == 0) return;
            record[density] = orNothing(record[density] * keptDensity_);
            record[temperature] = orNothing(record[temperature] * keptHeat_);
            record[reaction] = std::max(orNothing(record[reaction] - lost_), 0.0f);
        };
        const auto sixteenCells = [&](std::size_t i) {
            SixteenRecords::Quantities now = SixteenRecords(records + i * lanes).all();
            now[velocityX] += load<Float16>(&force.x[i]);
            now[velocityY] += load<Float16>(&force.y[i]);
            now[velocityZ] += load<Float16>(&force.z[i]);
            now[density] *= keptDensity_;
            now[temperature] *= keptHeat_;
            now[reaction] -= lost_;
            for (Float16& quantity : now) quantity = quantity > nothing || quantity < -nothing ? quantity : Float16{};
            now[reaction] = atLeast(now[reaction], Float16{});
            SixteenRecords(now).storeTo(records + i * lanes);
        };
        forMoving(moving + at, static_cast<std::size_t>(layout.nx), sixteenCells, cell);
    }

 private:
    float keptDensity_, keptHeat_, lost_;
};

}  // namespace

std::size_t forceFloats(const CellLayout& layout) {
    return 5 * layout.rows() * static_cast<std::size_t>(layout.nx);
}

void gatherCurl(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float spacingMetres,
                std::span<float> memory) {
    const Curl curl(layout, memory);
    struct Nothing {};
    forRowsInTiles<Nothing>(
        layout, [&](int j, int k, Nothing&) { curlOfRow(cells, layout, conductance, spacingMetres, j, k, curl); });
}

void applyForces(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, const Moving* moving,
                 const ForceSettings& settings, float spacingMetres, float stepSeconds, std::span<float> borrowed) {
    const Curl curl(layout, borrowed);
    const bool confined = settings.confinementPerSecond > 0;
    const float strength = settings.confinementPerSecond * spacingMetres * stepSeconds;
    const float lift = settings.buoyancyPerKelvin * stepSeconds, weight = settings.weightPerDensity * stepSeconds;
    const Change change(settings, stepSeconds);
    enum Stage : std::size_t { findForces, confine, wait, apply, stages };  // a face needs forces two slabs before it
    parallel::forStages(static_cast<std::size_t>(layout.nz), stages, 2 * parallel::threadCount(),
                        [&](std::size_t stage, std::size_t slab) {
                            if (stage == wait) return;
                            const int k = static_cast<int>(slab);
                            AddedRow added;
                            for (int j = 0; j < layout.ny; ++j) {
                                if (stage == findForces) {
                                    if (confined) curlOfRow(cells, layout, conductance, spacingMetres, j, k, curl);
                                    findLift(cells, layout, j, k, lift, weight, curl.lift);
                                } else if (stage == confine) {
                                    if (confined) confineRow(curl, layout, j, k, strength);
                                } else {
                                    facesOfRow(curl, layout, j, k, confined, added);
                                    change.row(cells, layout, moving, j, k, added);
                                }
                            }
                        });
}

void diffuse(CellField& cells, const CellLayout& layout, const Moving* moving, float diffusion,
             std::span<float> borrowed) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const std::size_t row = layout.row * lanes, slab = layout.slab * lanes;
    const auto forRows = [&](const auto& cell) {
        parallel::forEachBlock(layout.rows(), diffusedRows, [&](std::size_t first, std::size_t count) {
            for (std::size_t r = first; r < first + count; ++r) {
                const std::size_t at = layout.at(0, layout.rowJ(r), layout.rowK(r));
                for (std::size_t i = 0; i < nx; ++i)
                    cell(cells.cell(at + i), borrowed.data() + 3 * (r * nx + i), moving[at + i]);
            }
        });
    };
    forRows([&](const float* own, float* change, Moving moves) {
        for (std::size_t lane = 0; lane < 3; ++lane)
            change[lane] =
                (moves >> lane & 1) == 0
                    ? 0.0f
                    : diffusion * ((own + lanes)[lane] + (own - lanes)[lane] + (own + row)[lane] + (own - row)[lane] +
                                   (own + slab)[lane] + (own - slab)[lane] - 6 * own[lane]);
    });
    forRows([&](float* own, const float* change, Moving) {
        for (std::size_t lane = 0; lane < 3; ++lane) own[lane] += change[lane];
    });
}

}  // namespace dustbench::grid_fluid::flow
