// A field of vectors on a grid, as a file holds it.
//
// Units and frame: the file's own.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace dustbench::volumes {

/// Vectors at the centres of cubic cells; x runs fastest, z slowest.
struct VectorGrid {
    glm::ivec3 cells{0};
    glm::dvec3 origin{0};  ///< minimum corner of the first cell
    double spacing = 0;    ///< edge of a cell
    std::optional<double> timeSeconds;
    bool sparse = false;  ///< cells beyond it are zero, not unknown
    std::vector<glm::vec3> values;
};

}  // namespace dustbench::volumes
