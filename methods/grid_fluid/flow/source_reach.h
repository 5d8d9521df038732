// The cells that a source reaches, and what it adds to them in a step; the same for every backend.
//
// Units: cells, seconds. Threads: pure.
#pragma once

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/grid_fluid/flow/fluid_source.h"

namespace dustbench::grid_fluid::flow {

struct SourceReach {
    glm::dvec3 centreCells{0};  ///< of cell (0, 0, 0) the middle is 0
    float perRadius = 1;        ///< one over the radius, which is half a cell at least
    glm::ivec3 first{0}, last{-1};

    [[nodiscard]] bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

/// Throws InputError for a source without a radius.
[[nodiscard]] SourceReach reachOf(const FluidSource& source, const FluidBox& box);

}  // namespace dustbench::grid_fluid::flow
