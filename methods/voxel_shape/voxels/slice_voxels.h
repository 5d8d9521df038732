// The paper's voxeliser on the CPU: marks a voxel if the line along z through its centre meets the mesh inside it.
//
// The reference implementation of SlicePass, which draws the same layer by layer. Misses triangles that are edge-on,
// and possibly parts thinner than a voxel, as does the paper's algorithm.
//
// Frame: the mesh's own. Threads: uses the current oneTBB arena; the result does not depend on the number of threads.
// Source: JuckelBeckhaus2007, 4.2.
#pragma once

#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// Voxelises a mesh. A voxel has the colour of the mesh point in it with the maximum z, which a depth test from above
/// keeps. Throws InputError if the mesh is not sound.
[[nodiscard]] MarkedVoxels sliceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
