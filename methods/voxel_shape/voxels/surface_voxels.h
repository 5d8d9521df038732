// Voxelises the surface of a mesh on the CPU: conservatively, or by the paper's slices.
//
// Frame: the mesh's own. Threads: uses the current oneTBB arena; the result does not depend on the number of threads.
// Source: Schwarz2010, 3.1 (conservative voxelisation); JuckelBeckhaus2007, 4.2 (slices).
#pragma once

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

/// Marks every voxel that the surface touches, however thin or edge-on a triangle is. A voxel's colour is the mean over
/// its triangles of their colour nearest to its centre. Departs from Schwarz2010: cells are widened by 1/256 of their
/// edge, the distance by which a GPU may shift a corner when rasterising, so that SlicePass never marks a voxel that is
/// not marked here. Throws InputError if the mesh is not sound.
[[nodiscard]] MarkedVoxels surfaceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

/// Marks a voxel if the line along z through its centre meets the mesh inside it: the reference implementation of
/// SlicePass, which draws the same layer by layer. Misses triangles that are edge-on, and possibly parts thinner than a
/// voxel, as does the paper's algorithm. A voxel has the colour of the mesh point in it with the maximum z, which a
/// depth test from above keeps. Throws InputError if the mesh is not sound.
[[nodiscard]] MarkedVoxels sliceVoxels(const scene::Mesh& mesh, const Lattice& lattice);

}  // namespace dustbench::voxel_shape
