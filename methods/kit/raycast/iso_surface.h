// The surface on which a grid's density has one value, by VTK's flying edges.
//
// Units: metres. Frame: the grid's minimum corner. VTK stays out of this header.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

struct IsoSurface {
    struct Vertex {
        glm::vec3 place, normal;  ///< the normal points to where there is less
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three for each triangle
};

/// Closed: beyond the grid there is nothing. `density` must be more than 0.
[[nodiscard]] IsoSurface isoSurface(const ShownGrid& grid, double density);

}  // namespace dustbench::raycast
