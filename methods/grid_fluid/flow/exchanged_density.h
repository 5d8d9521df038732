// Density that a fluid's box passes to its surroundings, or receives from them.
//
// Units: cells, and density summed over cells.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

/// The density that left the box through a face of an open side in a step.
struct LeavingDensity {
    glm::ivec3 cell;  ///< the cell that it left
    int axis;         ///< of the face
    bool far;         ///< towards +axis
    float cells;      ///< distance that it travelled
    float density;    ///< summed over cells
};

/// The density that a cell receives.
struct AddedDensity {
    glm::ivec3 cell;
    float density;
};

}  // namespace dustbench::grid_fluid::flow
