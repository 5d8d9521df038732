// Shapes that overlap: a particle of one shape inside a voxel of another takes on the other shape's motion.
//
// Source: JuckelBeckhaus2007, 7 (`interaction between more than one particle system should be implemented`). Departs:
// the paper gives no law; we use that of air drag, v ← v + s·(u − v), u: the other shape's velocity at the particle.
// Units: m/s. Frame: world. Threads: uses the current oneTBB arena. The result depends neither on the number of threads
// nor on the order of the shapes: a particle sees the other shapes' voxels, never their particles.
#pragma once

#include "methods/voxel_shape/particles/shape_system.h"

namespace dustbench::voxel_shape {

/// Applies the law to the particles of `moved` in voxels of `by` that are switched on; both shapes must be at the same
/// time. `share`: s. Returns the number of those particles.
std::size_t drawAlong(ShapeSystem& moved, const ShapeSystem& by, float share);

}  // namespace dustbench::voxel_shape
