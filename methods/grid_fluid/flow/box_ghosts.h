// Fills the ghost cells, which represent the outside of the six sides of the box.
//
// Units: metres per second. Threads: rows in blocks.
#pragma once

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/fluid_box.h"

namespace dustbench::grid_fluid::flow {

struct GhostRule {
    Sides sides = openOverFloor;
    glm::vec3 windMetresPerSecond{0};
    bool noSlip = false;
};

/// Purpose of the ghosts of a wall.
enum class GhostUse {
    lookUp,  ///< mirrored flow, which vanishes halfway, at the wall
    faces,   ///< the speed of the wall itself, as for a solid
};

/// Beyond an open side the flow is extended, in clear air; beyond an inflow there is the wind, in clear air.
void fillGhosts(CellField& cells, const CellLayout& layout, const GhostRule& rule, GhostUse use);

}  // namespace dustbench::grid_fluid::flow
