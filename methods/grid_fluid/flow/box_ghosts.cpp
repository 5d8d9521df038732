#include "methods/grid_fluid/flow/box_ghosts.h"

#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::grid_fluid::flow {
namespace {

void fillOne(float* ghost, const float* inner, std::size_t axis, const GhostRule& rule, Side side, GhostUse use) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const bool isVelocity = lane < 3;
        if (side == Side::inflow)
            ghost[lane] = isVelocity ? rule.windMetresPerSecond[static_cast<int>(lane)] : 0;
        else if (side == Side::open)
            ghost[lane] = isVelocity ? inner[lane] : 0;
        else if (use == GhostUse::faces && lane == axis)
            ghost[lane] = 0;
        else
            ghost[lane] = isVelocity && (lane == axis || rule.noSlip) ? -inner[lane] : inner[lane];
    }
}

}  // namespace

void fillGhosts(CellField& cells, const CellLayout& layout, const GhostRule& rule, GhostUse use) {
    const int nx = layout.nx, ny = layout.ny, nz = layout.nz;
    const auto fillRow = [&](int toJ, int toK, int fromJ, int fromK, std::size_t axis, Side side) {
        float* ghost = cells.cell(layout.at(-1, toJ, toK));
        const float* inner = cells.cell(layout.at(-1, fromJ, fromK));
        for (int i = 0; i < nx + 2; ++i, ghost += lanes, inner += lanes) fillOne(ghost, inner, axis, rule, side, use);
    };
    // Along x, then y, then z, so that edges and corners are filled from ghosts.
    parallel::forEachBlock(static_cast<std::size_t>(nz), 4, [&](std::size_t first, std::size_t count) {
        for (std::size_t slab = first; slab < first + count; ++slab) {
            const int k = static_cast<int>(slab);
            for (int j = 0; j < ny; ++j) {
                float* left = cells.cell(layout.at(-1, j, k));
                float* right = cells.cell(layout.at(nx, j, k));
                fillOne(left, left + lanes, 0, rule, rule.sides[0], use);
                fillOne(right, right - lanes, 0, rule, rule.sides[1], use);
            }
            fillRow(-1, k, 0, k, 1, rule.sides[2]);
            fillRow(ny, k, ny - 1, k, 1, rule.sides[3]);
        }
    });
    parallel::forEachBlock(static_cast<std::size_t>(ny) + 2, 16, [&](std::size_t first, std::size_t count) {
        for (std::size_t row = first; row < first + count; ++row) {
            const int j = static_cast<int>(row) - 1;
            fillRow(j, -1, j, 0, 2, rule.sides[4]);
            fillRow(j, nz, j, nz - 1, 2, rule.sides[5]);
        }
    });
}

}  // namespace dustbench::grid_fluid::flow
