#include "methods/grid_fluid/flow/fluid_source.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/contract/errors.h"

namespace dustbench::grid_fluid::flow {

SourceReach reachOf(const FluidSource& source, const FluidBox& box) {
    if (!(source.radiusMetres > 0))
        throw InputError("source: got a radius of " + std::to_string(source.radiusMetres) + " m, allowed: more than 0");
    SourceReach reach;
    reach.centreCells = (source.centreMetres - box.originMetres) / box.spacingMetres - 0.5;
    // A smaller one could fall between the cells.
    const double radiusCells = std::max(source.radiusMetres / box.spacingMetres, 0.5);
    reach.perRadius = static_cast<float>(1 / radiusCells);
    // Outside the box there are no cells; clamped first to avoid overflow for distant sources.
    const auto bound = [&](double cell, int axis) {
        return static_cast<int>(std::clamp(cell, -1.0, static_cast<double>(box.cells[axis])));
    };
    for (int axis = 0; axis < 3; ++axis) {
        reach.first[axis] = std::max(0, bound(std::ceil(reach.centreCells[axis] - 3 * radiusCells), axis));
        reach.last[axis] =
            std::min(box.cells[axis] - 1, bound(std::floor(reach.centreCells[axis] + 3 * radiusCells), axis));
    }
    return reach;
}

}  // namespace dustbench::grid_fluid::flow
