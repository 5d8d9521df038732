// A mesh divided into the things that it is made of: a scene keeps all copies of a stone or a post as one mesh.
//
// Threads: pure.
#pragma once

#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::voxel_shape {

/// Triangles that hang together by corners at the same place are one part, and so are parts whose bounding boxes meet,
/// like the boards of a crate. Each comes without normals, in the order of its first triangle.
[[nodiscard]] std::vector<scene::Mesh> partsOf(const scene::Mesh& mesh);

}  // namespace dustbench::voxel_shape
