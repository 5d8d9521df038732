// Checks whether a mesh is closed.
//
// Threads: pure.
#pragma once

#include <cstddef>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

/// Edges that belong to an odd number of triangles; corners at the same place count as one. 0 for a closed surface.
[[nodiscard]] DUSTBENCH_API std::size_t openEdges(const scene::Mesh& mesh);

}  // namespace dustbench::meshes
