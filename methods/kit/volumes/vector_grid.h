// A vector field on a grid, as stored in a file.
//
// Units and frame: the file's own.
#pragma once

#include "methods/kit/volumes/grid_place.h"

namespace dustbench::volumes {

struct VectorGrid : GridPlace {
    std::vector<glm::vec3> values;
};

}  // namespace dustbench::volumes
