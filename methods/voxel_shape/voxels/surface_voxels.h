// Conservative voxelisation: marks every voxel that a mesh's surface touches, however thin or edge-on a triangle is.
//
// Frame: the mesh's own. Threads: uses the current oneTBB arena; the result does not depend on the number of threads.
// Source: Schwarz2010, 3.1 (conservative voxelisation). Departs: cells are widened by 1/256 of their edge, the distance
// by which a GPU may shift a corner when rasterising, so that SlicePass never marks a voxel that is not marked here.
#pragma once

#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// Voxelises a mesh. A voxel's colour is the mean over its triangles of their colour nearest to its centre. Throws
/// InputError if the mesh is not sound.
[[nodiscard]] MarkedVoxels surfaceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
