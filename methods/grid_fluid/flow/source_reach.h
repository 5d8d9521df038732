// The cells affected by a source, and its contribution to them in a step; the same for every backend.
//
// Units: cells, seconds. Threads: pure.
#pragma once

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"

namespace dustbench::grid_fluid::flow {

struct SourceReach {
    glm::dvec3 centreCells{0};  ///< the centre of cell (0, 0, 0) is at 0
    float perRadius = 1;        ///< inverse radius; the radius is at least half a cell
    glm::ivec3 first{0}, last{-1};

    [[nodiscard]] bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

/// Throws InputError for a source without a radius.
[[nodiscard]] SourceReach reachOf(const FluidSource& source, const FluidBox& box);

}  // namespace dustbench::grid_fluid::flow
