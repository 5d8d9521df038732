// Density on a grid, as stored in a file, with further fields of the smoke.
//
// Units and frame: the file's own.
#pragma once

#include "methods/kit/volumes/grid_place.h"

namespace dustbench::volumes {

struct VolumeGrid : GridPlace {
    std::vector<float> density;
    std::vector<float> temperature;   ///< empty: none
    std::vector<glm::vec3> velocity;  ///< empty: none
};

}  // namespace dustbench::volumes
