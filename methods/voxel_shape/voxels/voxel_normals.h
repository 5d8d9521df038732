// The direction in which a shape's surface faces at each voxel: away from its matter.
//
// Frame: the shape's own. Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Returns a unit vector for each of `grid.active()`: the negative gradient of the matter (active voxels and the cells
/// they enclose) over the voxels up to two away; (0, 0, 0) if the matter is symmetric.
[[nodiscard]] std::vector<glm::vec3> normalsOf(const VoxelGrid& grid);

}  // namespace dustbench::voxel_shape
