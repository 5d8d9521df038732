// Computes the areas of the ground that an object's shadow can reach.
//
// Units: metres. Frame: world. Threads: pure.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/contract/solid.h"
#include "methods/contract/terrain.h"
#include "methods/kit/draw/ground_lattice.h"

namespace dustbench::draw {

/// Bounds, seen from above, of the box `minimum`..`maximum` (transformed by `toWorld`) and its shadow, enlarged by
/// `marginMetres`. A sun below 6° is treated as if at 6°.
[[nodiscard]] GroundRectangle shadowFootprint(const glm::vec3& minimum, const glm::vec3& maximum,
                                              const glm::dmat4& toWorld, const glm::vec3& toSun,
                                              const scene::Terrain& terrain, double marginMetres);

/// The same for a mesh that may consist of many separate objects (a row of posts): one rectangle per group of
/// neighbouring objects. The rectangles do not overlap.
[[nodiscard]] std::vector<GroundRectangle> shadowFootprints(const scene::Mesh& mesh, const glm::dmat4& toWorld,
                                                            const glm::vec3& toSun, const scene::Terrain& terrain,
                                                            double marginMetres);

/// Merges overlapping rectangles until none overlap, so that no ground is drawn twice.
void joinOverlapping(std::vector<GroundRectangle>& rectangles);

}  // namespace dustbench::draw
