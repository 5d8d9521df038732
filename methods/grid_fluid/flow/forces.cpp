#include "methods/grid_fluid/flow/forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/grid_fluid/flow/lanes.h"
#include "methods/grid_fluid/flow/row_tiles.h"
#include "methods/grid_fluid/flow/sixteen_records.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

constexpr std::size_t rowsInABlock = 32;
constexpr std::size_t maximumCells = 4096;
/// Smaller values are set to 0: otherwise fading smoke becomes denormal numbers, which are slow.
constexpr float nothing = 1e-18f;

struct Curl {
    Curl(const CellLayout& layout, std::span<float> memory)
        : count(layout.rows() * static_cast<std::size_t>(layout.nx)),
          x(memory.data()),
          y(x + count),
          z(y + count),
          length(z + count) {}
    std::size_t count;
    float *x, *y, *z, *length;
};

/// Rows of a force in m/s², ready to be added.
struct ForceRows {
    std::array<float, maximumCells> x, y, z;
};

/// f = ε·h·(N × ω), N = ∇|ω| / |∇|ω||. Beyond the box |ω| is extended.
void confinementRow(const Curl& curl, const CellLayout& layout, int j, int k, float strength, ForceRows& force) {
    const auto nx = static_cast<std::size_t>(layout.nx), slab = nx * static_cast<std::size_t>(layout.ny);
    const std::size_t at = static_cast<std::size_t>(k) * slab + static_cast<std::size_t>(j) * nx;
    const float* own = curl.length + at;
    const float* below = j > 0 ? own - nx : own;
    const float* above = j + 1 < layout.ny ? own + nx : own;
    const float* before = k > 0 ? own - slab : own;
    const float* behind = k + 1 < layout.nz ? own + slab : own;
    const float *wx = curl.x + at, *wy = curl.y + at, *wz = curl.z + at;
    const auto cell = [&](std::size_t i, float left, float right) {
        const float gx = right - left, gy = above[i] - below[i], gz = behind[i] - before[i];
        const float scale = strength / std::sqrt(gx * gx + gy * gy + gz * gz + 1e-20f);
        force.x[i] = scale * (gy * wz[i] - gz * wy[i]);
        force.y[i] = scale * (gz * wx[i] - gx * wz[i]);
        force.z[i] = scale * (gx * wy[i] - gy * wx[i]);
    };
#pragma GCC ivdep
    for (std::size_t i = 1; i + 1 < nx; ++i) cell(i, own[i - 1], own[i + 1]);
    cell(0, own[0], own[1]);
    cell(nx - 1, own[nx - 2], own[nx - 1]);
}

}  // namespace

std::size_t forceFloats(const CellLayout& layout) {
    return 4 * layout.rows() * static_cast<std::size_t>(layout.nx);
}

void gatherCurl(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float spacingMetres,
                std::span<float> memory) {
    const Curl curl(layout, memory);
    const float perTwoCells = 0.5f / spacingMetres;
    const auto nx = static_cast<std::size_t>(layout.nx);
    struct Nothing {};
    forRowsInTiles<Nothing>(layout, [&](int j, int k, Nothing&) {
        const std::size_t at = layout.at(0, j, k);
        const std::size_t r =
            static_cast<std::size_t>(k) * static_cast<std::size_t>(layout.ny) + static_cast<std::size_t>(j);
        const float* own = cells.cell(at);
        const std::size_t row = layout.row * lanes, slab = layout.slab * lanes;
        float *x = curl.x + r * nx, *y = curl.y + r * nx, *z = curl.z + r * nx, *length = curl.length + r * nx;
        const auto cell = [&](std::size_t i) {
            const float fluid = conductance[at + i] == 1 ? perTwoCells : 0.0f;
            const float* record = own + i * lanes;
            const Float4 alongX = load<Float4>(record + lanes) - load<Float4>(record - lanes);
            const Float4 alongY = load<Float4>(record + row) - load<Float4>(record - row);
            const Float4 alongZ = load<Float4>(record + slab) - load<Float4>(record - slab);
            x[i] = (alongY[2] - alongZ[1]) * fluid;
            y[i] = (alongZ[0] - alongX[2]) * fluid;
            z[i] = (alongX[1] - alongY[0]) * fluid;
        };
        const auto sixteenCells = [&](std::size_t i) {
            const float* records = own + i * lanes;
            const SixteenRecords alongX = SixteenRecords(records + lanes) - SixteenRecords(records - lanes);
            const SixteenRecords alongY = SixteenRecords(records + row) - SixteenRecords(records - row);
            const SixteenRecords alongZ = SixteenRecords(records + slab) - SixteenRecords(records - slab);
            store(x + i, (alongY.get<2>() - alongZ.get<1>()) * perTwoCells);
            store(y + i, (alongZ.get<0>() - alongX.get<2>()) * perTwoCells);
            store(z + i, (alongX.get<1>() - alongY.get<0>()) * perTwoCells);
        };
        forCells(conductance + at, nx, sixteenCells, cell);
#pragma GCC ivdep
        for (std::size_t i = 0; i < nx; ++i) length[i] = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    });
}

void applyForces(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                 const ForceSettings& settings, float spacingMetres, float stepSeconds, std::span<float> borrowed) {
    const Curl curl(layout, borrowed);
    const bool confined = settings.confinementPerSecond > 0;
    if (confined) gatherCurl(cells, layout, conductance, spacingMetres, borrowed);
    const float strength = settings.confinementPerSecond * spacingMetres * stepSeconds;
    const float keptDensity = std::exp(-settings.densityDecayPerSecond * stepSeconds);
    const float keptHeat = std::exp(-settings.coolingPerSecond * stepSeconds);
    const float lost = settings.reactionLossPerSecond * stepSeconds;
    const Float8 kept{1, 1, 1, keptDensity, keptHeat, 1, 0, 0};
    const float lift = settings.buoyancyPerKelvin * stepSeconds, weight = settings.weightPerDensity * stepSeconds;
    const auto nx = static_cast<std::size_t>(layout.nx);
    forRowsInTiles<ForceRows>(layout, [&](int j, int k, ForceRows& force) {
        const std::size_t at = layout.at(0, j, k);
        float* records = cells.cell(at);
        if (confined) confinementRow(curl, layout, j, k, strength, force);
        const auto cell = [&](std::size_t i) {
            if (conductance[at + i] != 1) return;
            float* record = records + i * lanes;
            const auto old = load<Float8>(record);
            const float rise = force.y[i] + (lift * old[temperature] - weight * old[density]);
            Float8 now = old * kept + Float8{force.x[i], rise, force.z[i], 0, 0, -lost, 0, 0};
            now = now > nothing || now < -nothing ? now : Float8{};
            store(record, __builtin_shufflevector(now, now, 0, 1, 2, 3));
            record[temperature] = now[temperature];
            record[reaction] = now[reaction] > 0 ? now[reaction] : 0.0f;
        };
        const auto sixteenCells = [&](std::size_t i) {
            SixteenRecords::Quantities now = SixteenRecords(records + i * lanes).all();
            now[velocityX] += load<Float16>(&force.x[i]);
            now[velocityY] += load<Float16>(&force.y[i]) + (lift * now[temperature] - weight * now[density]);
            now[velocityZ] += load<Float16>(&force.z[i]);
            now[density] *= keptDensity;
            now[temperature] *= keptHeat;
            now[reaction] -= lost;
            for (Float16& quantity : now) quantity = quantity > nothing || quantity < -nothing ? quantity : Float16{};
            now[reaction] = atLeast(now[reaction], Float16{});
            SixteenRecords(now).storeTo(records + i * lanes);
        };
        forCells(conductance + at, nx, sixteenCells, cell);
    });
}

void diffuse(CellField& cells, const CellLayout& layout, const std::uint8_t* conductance, float diffusion,
             std::span<float> borrowed) {
    const auto nx = static_cast<std::size_t>(layout.nx);
    const std::size_t row = layout.row * lanes, slab = layout.slab * lanes;
    const auto forRows = [&](const auto& cell) {
        parallel::forEachBlock(layout.rows(), rowsInABlock, [&](std::size_t first, std::size_t count) {
            for (std::size_t r = first; r < first + count; ++r) {
                const std::size_t at = layout.at(0, layout.rowJ(r), layout.rowK(r));
                for (std::size_t i = 0; i < nx; ++i)
                    if (conductance[at + i] == 1) cell(cells.cell(at + i), borrowed.data() + 3 * (r * nx + i));
            }
        });
    };
    forRows([&](const float* own, float* change) {
        for (std::size_t lane = 0; lane < 3; ++lane)
            change[lane] = diffusion * ((own + lanes)[lane] + (own - lanes)[lane] + (own + row)[lane] +
                                        (own - row)[lane] + (own + slab)[lane] + (own - slab)[lane] - 6 * own[lane]);
    });
    forRows([&](float* own, const float* change) {
        for (std::size_t lane = 0; lane < 3; ++lane) own[lane] += change[lane];
    });
}

}  // namespace dustbench::grid_fluid::flow
