// Where on the ground a thing's shadow can fall.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/solid.h"
#include "methods/contract/terrain.h"
#include "methods/kit/draw/ground_lattice.h"

namespace dustbench::draw {

/// Bounds, seen from above, of the box `minimum`..`maximum` (moved by `toWorld`) and of its shadow, and `marginMetres`
/// more. A sun below 6° throws no longer shadows than one at 6°.
[[nodiscard]] GroundRectangle shadowFootprint(const glm::vec3& minimum, const glm::vec3& maximum,
                                              const glm::dmat4& toWorld, const glm::vec3& toSun,
                                              const scene::Terrain& terrain, double marginMetres);

/// The same for a mesh that may be many things far apart (a row of posts): one rectangle for what stands together.
/// No two of them overlap.
[[nodiscard]] std::vector<GroundRectangle> shadowFootprints(const scene::Mesh& mesh, const glm::dmat4& toWorld,
                                                            const glm::vec3& toSun, const scene::Terrain& terrain,
                                                            double marginMetres);

/// Joins rectangles that overlap, until none do: ground under two shadows need not be drawn twice.
void joinOverlapping(std::vector<GroundRectangle>& rectangles);

}  // namespace dustbench::draw
