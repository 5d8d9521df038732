// Where the octree's world lies: a cube that follows the vehicle in whole steps, so that its lattice stays fixed in the
// world.
//
// Units: metres. Frame: world.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::octree {

/// Least corner of the cube of edge `edgeMetres` round `centre`, moved in steps of `stepMetres` (the coarsest voxel's
/// edge). On level ground y = 0 is the cube's middle. Throws std::invalid_argument unless 0 < stepMetres ≤ edgeMetres.
[[nodiscard]] glm::dvec3 octreeWorldOrigin(const glm::dvec3& centre, double edgeMetres, double stepMetres);

}  // namespace dustbench::octree
