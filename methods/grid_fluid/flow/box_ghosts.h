// The sides of the box: the speeds of its outermost faces, and the ghost cells beyond, for sampling.
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

/// The faces on the sides: 0 at a wall, the wind's speed at an inflow, that of the next face at an open side.
void setSideFaces(CellField& cells, const CellLayout& layout, const GhostRule& rule);

/// Fills the ghosts: beyond a wall the flow is mirrored, or reversed without slip; beyond an open side it continues, in
/// clear air; beyond an inflow there is the wind, in clear air. The faces on the sides do not change.
void fillGhosts(CellField& cells, const CellLayout& layout, const GhostRule& rule);

}  // namespace dustbench::grid_fluid::flow
