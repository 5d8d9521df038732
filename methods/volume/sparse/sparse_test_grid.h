// Sparse moments of dense grids, for tests and benchmarks.
#pragma once

#include <limits>

#include "methods/kit/raycast/raycast_test_grid.h"
#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

/// The sparse moment of a grid whose first cell is at this place on the lattice.
inline void fill(SparseMoment& moment, const raycast::TestGrid& grid, const glm::ivec3& firstCell) {
    moment.cells = grid.cells;
    moment.spacingMetres = grid.spacingMetres;
    moment.originMetres = grid.originMetres;
    moment.firstCell = firstCell;
    Bricks densities, reactions;
    std::size_t i = 0;
    for (glm::ivec3 cell(0); cell.z < grid.cells.z; ++cell.z)
        for (cell.y = 0; cell.y < grid.cells.y; ++cell.y)
            for (cell.x = 0; cell.x < grid.cells.x; ++cell.x, ++i) {
                const glm::ivec3 at = cell + firstCell;
                const auto place = static_cast<std::size_t>((at.x & 7) << 6 | (at.y & 7) << 3 | (at.z & 7));
                if (grid.density[i] > 0) densities.at(at >> 3)[place] = grid.density[i];
                if (!grid.reaction.empty()) reactions.at(at >> 3)[place] = std::clamp(grid.reaction[i], 0.0f, 1.0f);
            }
    const glm::dvec3 origin = grid.originMetres - grid.spacingMetres * glm::dvec3(firstCell);
    constexpr std::size_t noLimit = std::numeric_limits<std::size_t>::max();
    plantDensities(densities, grid.spacingMetres, origin, noLimit, moment.density);
    if (!grid.reaction.empty()) plantAll(reactions, grid.spacingMetres, origin, noLimit, moment.reaction);
}

}  // namespace dustbench::volume
