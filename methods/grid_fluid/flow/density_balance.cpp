#include "methods/grid_fluid/flow/density_balance.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

/// Limits the effect of a wrong balance, for example if the whole cloud leaves at once.
constexpr double maximumChange = 0.1;

}  // namespace

double densityTotal(const CellField& cells, const CellLayout& layout) {
    std::vector<double> slabs(static_cast<std::size_t>(layout.nz));
    parallel::forEachBlock(slabs.size(), 4, [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k)
            for (int j = 0; j < layout.ny; ++j) {
                const float* record = cells.cell(layout.at(0, j, static_cast<int>(k)));
                float row = 0;
                for (int i = 0; i < layout.nx; ++i, record += lanes) row += record[density];
                slabs[k] += static_cast<double>(row);
            }
    });
    return std::accumulate(slabs.begin(), slabs.end(), 0.0);
}

double densityLeaving(const CellField& cells, const CellLayout& layout, const std::uint8_t* conductance,
                      float cellsPerSpeed, std::vector<LeavingDensity>* note) {
    const glm::ivec3 size(layout.nx, layout.ny, layout.nz);
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const bool far : {false, true}) {
            glm::ivec3 cell(0);
            cell[axis] = far ? size[axis] - 1 : 0;
            glm::ivec3 beyond = cell;
            for (cell[c] = 0; cell[c] < size[c]; ++cell[c])
                for (cell[b] = 0; cell[b] < size[b]; ++cell[b]) {
                    beyond = cell;
                    beyond[axis] += far ? 1 : -1;
                    if (conductance[layout.at(beyond.x, beyond.y, beyond.z)] != 2) continue;
                    const float* record = cells.cell(layout.at(cell.x, cell.y, cell.z));
                    const float* face = far ? cells.cell(layout.at(beyond.x, beyond.y, beyond.z)) : record;
                    const float out = (far ? face[axis] : -face[axis]) * cellsPerSpeed;
                    if (!(out > 0) || record[density] == 0) continue;
                    const float leaving = out * record[density];
                    sum += static_cast<double>(leaving);
                    if (note) note->push_back({cell, axis, far, out, leaving});
                }
        }
    }
    return sum;
}

void scaleDensity(CellField& cells, const CellLayout& layout, double total) {
    const double now = densityTotal(cells, layout);
    if (!(now > 0)) return;
    const auto scale = static_cast<float>(std::clamp(total / now, 1 - maximumChange, 1 + maximumChange));
    parallel::forEachBlock(layout.rows(), 64, [&](std::size_t first, std::size_t count) {
        for (std::size_t r = first; r < first + count; ++r) {
            float* record = cells.cell(layout.at(0, layout.rowJ(r), layout.rowK(r)));
            for (int i = 0; i < layout.nx; ++i, record += lanes) record[density] *= scale;
        }
    });
}

}  // namespace dustbench::grid_fluid::flow
