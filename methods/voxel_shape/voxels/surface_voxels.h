// The voxels that a mesh's surface touches: none is missed, however thin or edge-on a triangle is.
//
// Frame: the mesh's own. Threads: uses the current oneTBB arena; the result is the same at any number of threads.
// Source: Schwarz2010, 3.1 (conservative voxelisation). Departs: cells are widened by 1/256 of their edge, by
// which a GPU may move a corner that it rasterises: so that SlicePass finds none that is not here.
#pragma once

#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// A voxel's colour is the mean over its triangles of their colour nearest to its centre. Throws InputError for a mesh
/// that is not sound.
[[nodiscard]] MarkedVoxels surfaceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
