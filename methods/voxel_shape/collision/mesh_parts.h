// Splits a mesh into separate objects: a scene stores all copies of a stone or a post as one mesh.
//
// Threads: pure.
#pragma once

#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::voxel_shape {

/// Returns the parts of a mesh. Triangles that share a corner position belong to one part; so do parts whose bounding
/// boxes overlap, like the boards of a crate. The parts have no normals and are ordered by their first triangle.
[[nodiscard]] std::vector<scene::Mesh> partsOf(const scene::Mesh& mesh);

}  // namespace dustbench::voxel_shape
