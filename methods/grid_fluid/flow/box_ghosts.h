// Fills the ghost cells: what lies beyond the six sides of the box.
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

/// What the ghosts of a wall are for.
enum class GhostUse {
    lookUp,  ///< the flow mirrored, so that it vanishes halfway, at the wall
    faces,   ///< the speed of the wall itself, like that of a solid
};

/// Beyond an open side the flow goes on, in clear air; beyond an inflow there is the wind, in clear air.
void fillGhosts(CellField& cells, const CellLayout& layout, const GhostRule& rule, GhostUse use);

}  // namespace dustbench::grid_fluid::flow
