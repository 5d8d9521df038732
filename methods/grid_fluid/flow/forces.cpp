#include "methods/grid_fluid/flow/forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/grid_fluid/flow/curl.h"
#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/parallel/for_stages.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::size_t diffusedRows = 32;
constexpr std::size_t maximumForcedCells = 4096;
/// Smaller values are set to 0: otherwise fading smoke becomes denormal numbers, which are slow.
constexpr float nothing = 1e-18f;

/// f = ε·h·(N × ω), N = ∇|ω| / |∇|ω||, in place of ω. Beyond the box |ω| is extended.
void confineRow(const CurlField& field, const CellLayout& layout, int j, int k, float strength) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const float* own = field.length(j, k);
    const float* below = field.length(std::max(j - 1, 0), k);
    const float* above = field.length(std::min(j + 1, layout.ny - 1), k);
    const float* before = field.length(j, std::max(k - 1, 0));
    const float* behind = field.length(j, std::min(k + 1, layout.nz - 1));
    const std::size_t at = field.row(j, k);
    float *wx = field.curl()[0] + at, *wy = field.curl()[1] + at, *wz = field.curl()[2] + at;
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

/// Speeds that confinement adds to the faces of a row's cells, in m/s.
struct ConfinedRow {
    std::array<float, maximumForcedCells> x, y, z;
    std::array<float, maximumForcedCells + 3> sum;  ///< over rows; see sumOfRows
};

/// Weights of the cells around a cell, (1, 2, 1)/4, and around the face towards its previous neighbour: the mean of the
/// weights around both cells.
constexpr std::array<float, 3> aroundCell{0.25f, 0.5f, 0.25f};
constexpr std::array<float, 4> aroundFace{0.125f, 0.375f, 0.375f, 0.125f};  // from two cells before to one after

/// The sum over rows around row (j, k) with these weights along y and z; beyond the box the outermost rows are
/// repeated. `sum` has room for two cells before the row and one behind it.
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

/// A face gets the mean force of its two cells, which is first smoothed over the cells around each by (1, 2, 1)/4 along
/// each axis. Otherwise it would change direction from cell to cell where |ω| varies little, as N does.
void facesOfRow(const CurlField& field, const CellLayout& layout, int j, int k, ConfinedRow& row) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const auto& force = field.curl();
    float* sum = row.sum.data() + 2;
    sumOfRows(force[0], layout, j, k, aroundCell, aroundCell, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) {
        const float* s = sum + i;
        row.x[i] = aroundFace[0] * s[-2] + aroundFace[1] * s[-1] + aroundFace[2] * s[0] + aroundFace[3] * s[1];
    }
    const auto spreadAlongX = [&](std::size_t i) {
        const float* s = sum + i;
        return aroundCell[0] * s[-1] + aroundCell[1] * s[0] + aroundCell[2] * s[1];
    };
    sumOfRows(force[1], layout, j, k, aroundFace, aroundCell, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) row.y[i] = spreadAlongX(i);
    sumOfRows(force[2], layout, j, k, aroundCell, aroundFace, sum);
#pragma GCC ivdep
    for (std::size_t i = 0; i < nx; ++i) row.z[i] = spreadAlongX(i);
}

float orNothing(float value) {
    return value > nothing || value < -nothing ? value : 0.0f;
}

/// Calls `sixteenCells(first)` where all parts of sixteen cells move, otherwise `cell(i)` one by one.
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

/// Lift at the centres of a row's cells, in m/s.
using LiftedRow = std::array<float, maximumForcedCells>;

/// The changes of a step to the cells of a row: forces on the faces, and decay at the centres.
class Change {
 public:
    Change(const ForceSettings& settings, float stepSeconds)
        : buoyancy_(settings.buoyancyPerKelvin * stepSeconds),
          weight_(settings.weightPerDensity * stepSeconds),
          keptDensity_(std::exp(-settings.densityDecayPerSecond * stepSeconds)),
          keptHeat_(std::exp(-settings.coolingPerSecond * stepSeconds)),
          lost_(settings.reactionLossPerSecond * stepSeconds) {}

    /// Call this for the rows of a slab in the order of j: `below` contains the lift of row j − 1 before its change,
    /// and receives that of this row.
    void row(CellField& cells, const CellLayout& layout, const Moving* moving, int j, int k, const ConfinedRow& force,
             LiftedRow& below) const {
        const std::size_t at = layout.at(0, j, k);
        float* records = cells.cell(at);
        const auto liftOf = [&](const auto& heat, const auto& smoke) { return buoyancy_ * heat - weight_ * smoke; };
        const auto cell = [&](std::size_t i) {
            float* record = records + i * lanes;
            // Solids contain neither heat nor density.
            const float lift = liftOf(record[temperature], record[density]);
            const std::array<float, 3> added{force.x[i], 0.5f * (below[i] + lift) + force.y[i], force.z[i]};
            below[i] = lift;
            for (std::size_t axis = 0; axis < 3; ++axis)
                if ((moving[at + i] >> axis & 1) != 0) record[axis] = orNothing(record[axis] + added[axis]);
            if ((moving[at + i] & 8) == 0) return;
            record[density] = orNothing(record[density] * keptDensity_);
            record[temperature] = orNothing(record[temperature] * keptHeat_);
            record[reaction] = std::max(orNothing(record[reaction] - lost_), 0.0f);
        };
        const auto sixteenCells = [&](std::size_t i) {
            SixteenRecords::Quantities now = SixteenRecords(records + i * lanes).all();
            const Float16 lift = liftOf(now[temperature], now[density]);
            now[velocityX] += load<Float16>(&force.x[i]);
            now[velocityY] += 0.5f * (load<Float16>(&below[i]) + lift) + load<Float16>(&force.y[i]);
            now[velocityZ] += load<Float16>(&force.z[i]);
            store(&below[i], lift);
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
    float buoyancy_, weight_;
    float keptDensity_, keptHeat_, lost_;
};

}  // namespace

std::size_t forceFloats(const CellLayout& layout) {
    return CurlField::floats(layout);
}

void applyForces(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, const Moving* moving,
                 const ForceSettings& settings, float spacingMetres, float stepSeconds, std::span<float> borrowed) {
    CurlField curl(layout, borrowed);
    const bool confined = settings.confinementPerSecond > 0;
    const float strength = settings.confinementPerSecond * spacingMetres * stepSeconds;
    const Change change(settings, stepSeconds);
    const auto apply = [&](int k) {
        ConfinedRow force;
        if (!confined)
            for (auto* axis : {&force.x, &force.y, &force.z}) std::fill_n(axis->begin(), layout.nx, 0.0f);
        LiftedRow below;  // the faces of the first row are on the box's side and do not move
        std::fill_n(below.begin(), layout.nx, 0.0f);
        for (int j = 0; j < layout.ny; ++j) {
            if (confined) facesOfRow(curl, layout, j, k, force);
            change.row(cells, layout, moving, j, k, force, below);
        }
    };
    const auto slabs = static_cast<std::size_t>(layout.nz);
    if (!confined) {
        parallel::forEachBlock(slabs, 1, [&](std::size_t slab, std::size_t) { apply(static_cast<int>(slab)); });
        return;
    }
    enum Stage : std::size_t {
        speeds,
        vorticity,
        length,
        confine,
        wait,
        faces,
        stages
    };  // a face needs forces two slabs before it
    parallel::forStages(slabs, stages, 2 * parallel::threadCount(), [&](std::size_t stage, std::size_t slab) {
        const int k = static_cast<int>(slab);
        switch (stage) {
            case speeds:
                return curl.findSpeeds(cells, k);
            case vorticity:
                return curl.findCurl(conductance, spacingMetres, k);
            case length:
                return curl.findLength(k);
            case confine:
                for (int j = 0; j < layout.ny; ++j) confineRow(curl, layout, j, k, strength);
                return;
            case faces:
                return apply(k);
            default:
                return;
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
