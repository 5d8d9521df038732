// Fills a surface of voxels: whatever cannot be reached from outside without crossing it belongs to the shape.
//
// An open mesh has no inside of its own. Where its holes are narrower than a voxel its surface voxels still enclose
// one, and it is filled; where nothing is enclosed that is an error and no quiet surface, because who asks for a solid
// would else measure and see something that was not asked for.
//
// Threads: pure.
#pragma once

#include "methods/voxel_shape/voxels/marked_voxels.h"

namespace dustbench::voxel_shape {

/// Marks what `surface` encloses, and leaves its colours alone; false where that is nothing.
bool markInside(MarkedVoxels& surface);

/// Marks what `surface` (every touched voxel marked) encloses; false where that is nothing. Inner voxels take the
/// colour of the surface voxel from which the minimum steps lead to them.
bool fillInside(MarkedVoxels& surface);

/// The same for the surface of this mesh. Throws InputError where the mesh is open and encloses nothing.
void fillSolid(MarkedVoxels& surface, const scene::Mesh& mesh);

}  // namespace dustbench::voxel_shape
