// Drags a shape's particles along with a precomputed velocity field read from files.
//
// v ← v + s·(u(x, t) − v), u trilinear in space and linear in time; particles outside the field's grid are unchanged.
// Source: JuckelBeckhaus2007, 7 (`fluid dynamics were not added yet`). Units: m/s. Frame: world, or the shape's, with
// which the field then moves. Threads: one caller at
// a time; uses the current oneTBB arena; the result does not depend on the number of threads.
#pragma once

#include "methods/kit/particles/particle_store.h"
#include "methods/kit/volumes/vector_series.h"
#include "methods/voxel_shape/particles/pose.h"

namespace dustbench::voxel_shape {

/// Applies the equation above to all particles. `share`: s; `timeSeconds`: time in the series.
void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share);
/// The same with a field in the frame of a shape at this pose: u is relative to the shape, whose scale lengthens it.
void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, const Pose& pose, double timeSeconds,
               float share);

}  // namespace dustbench::voxel_shape
