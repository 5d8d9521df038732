// The paper's voxeliser on the CPU: a voxel is marked where the line along z through its middle meets the mesh in it.
//
// This is what SlicePass draws, layer by layer, and its check. Triangles seen edge-on are missed, and parts thinner
// than a voxel may be: the paper's own error.
//
// Frame: the mesh's own. Threads: uses the current oneTBB arena; the result is the same at any number of threads.
// Source: JuckelBeckhaus2007, 4.2.
#pragma once

#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// A voxel's colour is that of the triangle point in it with the maximum z, as a depth test from there leaves it.
/// Throws InputError for a mesh that is not sound.
[[nodiscard]] MarkedVoxels sliceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
