// Fills a surface of voxels: every cell that is unreachable from outside without crossing it belongs to the shape.
//
// An open mesh has no inside. If its holes are narrower than a voxel, the surface voxels still enclose one, which is
// filled. If nothing is enclosed, that is an error rather than a silent fallback to the surface: a user who asks for a
// solid must not measure something else.
//
// Threads: pure.
#pragma once

#include "methods/voxel_shape/voxels/lattice.h"

namespace dustbench::voxel_shape {

/// Marks the cells that `surface` encloses and does not change colours. Returns false if there are none.
bool markInside(MarkedVoxels& surface);

/// Marks the cells that `surface` (every touched voxel marked) encloses. Returns false if there are none. Inner voxels
/// take the colour of the surface voxel that is nearest in steps.
bool fillInside(MarkedVoxels& surface);

/// Calls fillInside for the surface of this mesh. Throws InputError if the mesh is open and encloses nothing.
void fillSolid(MarkedVoxels& surface, const scene::Mesh& mesh);

}  // namespace dustbench::voxel_shape
