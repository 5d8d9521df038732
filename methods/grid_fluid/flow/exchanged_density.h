// Density that a fluid's box gives to what lies around it, or gets from there.
//
// Units: cells, and density summed over cells.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::grid_fluid::flow {

/// What left the box through a face of an open side in a step.
struct LeavingDensity {
    glm::ivec3 cell;  ///< the one that it left
    int axis;         ///< of the face
    bool far;         ///< towards +axis
    float cells;      ///< how far it got
    float density;    ///< summed over cells
};

/// What a cell gets.
struct AddedDensity {
    glm::ivec3 cell;
    float density;
};

}  // namespace dustbench::grid_fluid::flow
