// Extracts the surface of constant density of a grid with VTK's flying edges.
//
// Units: metres. Frame: the grid's minimum corner. VTK is not included here.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "methods/kit/raycast/shown_grid.h"

namespace dustbench::raycast {

struct IsoSurface {
    struct Vertex {
        glm::vec3 place, normal;  ///< the normal points towards lower density
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  ///< three per triangle
};

/// The surface is closed: density is 0 beyond the grid. `density` must be more than 0.
[[nodiscard]] IsoSurface isoSurface(const ShownGrid& grid, double density);

}  // namespace dustbench::raycast
