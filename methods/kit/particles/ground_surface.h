// The scene's ground as a surface: hit from above; particles below it may rise.
//
// Units: m. Frame: world. Threads: pure. The surface is bilinear, as in scene::Terrain.
#pragma once

#include "methods/contract/terrain.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

/// Writes the share at which each path first hits the ground, or Surface::none.
void meetGround(const Ways& ways, const scene::Terrain& terrain, float* share);

}  // namespace dustbench::particles
