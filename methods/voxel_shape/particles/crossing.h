// Shapes that cross each other: a particle of one that is in a voxel of another is drawn along by it.
//
// Source: JuckelBeckhaus2007, 7 (`interaction between more than one particle system should be implemented`). Departs:
// the paper gives no law; ours is that of the air, v ← v + s·(u − v), with u the other shape's velocity at the place.
// Units: m/s. Frame: world. Threads: uses the current oneTBB arena; the result is the same at any number of threads,
// and whichever shape is asked first: particles of one never see those of the other, only its voxels.
#pragma once

#include "methods/voxel_shape/particles/shape_system.h"

namespace dustbench::voxel_shape {

/// Draws along those of `moved`'s particles that are in a voxel of `by` that is on. Both at one moment. `share`: of the
/// difference of velocities that is taken away. How many they were.
std::size_t drawAlong(ShapeSystem& moved, const ShapeSystem& by, float share);

}  // namespace dustbench::voxel_shape
