// A field of vectors on a grid, as a file holds it.
//
// Units and frame: the file's own.
#pragma once

#include "methods/kit/volumes/grid_place.h"

namespace dustbench::volumes {

struct VectorGrid : GridPlace {
    std::vector<glm::vec3> values;
};

}  // namespace dustbench::volumes
