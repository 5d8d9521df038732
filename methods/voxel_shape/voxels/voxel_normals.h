// Which way a shape's surface looks at each voxel: where its matter becomes less.
//
// Frame: the shape's own. Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

/// Unit vectors, one for each of `grid.active()`: the negative gradient of matter (active voxels and what they enclose)
/// over the voxels within two of it; (0, 0, 0) where matter is the same on all sides.
[[nodiscard]] std::vector<glm::vec3> normalsOf(const VoxelGrid& grid);

}  // namespace dustbench::voxel_shape
