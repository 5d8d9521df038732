// A shape in a flow that was computed before: its particles are drawn along by a field of velocities from files.
//
// v ← v + s·(u(x, t) − v), u trilinear in space and linear in time; beyond the field's grid particles are left alone.
// Source: JuckelBeckhaus2007, 7 (`fluid dynamics were not added yet`). Units: m/s. Frame: world. Threads: one caller at
// a time; uses the current oneTBB arena, and the result is the same at any number of threads.
#pragma once

#include "methods/kit/particles/particle_store.h"
#include "methods/kit/volumes/vector_series.h"

namespace dustbench::voxel_shape {

/// `share` s: of the difference of velocities that is taken away; `timeSeconds`: of the series.
void drawAlong(particles::ParticleStore& moved, const volumes::VectorSeries& flow, double timeSeconds, float share);

}  // namespace dustbench::voxel_shape
