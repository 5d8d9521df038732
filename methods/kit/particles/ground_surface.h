// The scene's ground as a surface: met from above; what is below may rise.
//
// Units: m. Frame: world. Threads: pure. The surface is the bilinear one of scene::Terrain.
#pragma once

#include "methods/contract/terrain.h"
#include "methods/kit/particles/surface.h"

namespace dustbench::particles {

/// Writes the share at which each way first meets the ground, or Surface::none.
void meetGround(const Ways& ways, const scene::Terrain& terrain, float* share);

}  // namespace dustbench::particles
