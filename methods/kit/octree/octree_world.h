// Places the octree's world: a cube that moves in whole steps, so that its lattice stays fixed in space.
// Units: metres. Frame: world.
#pragma once

#include <glm/glm.hpp>

namespace dustbench::octree {

/// Minimum corner of the cube of edge `edgeMetres` around `centre`, moved in steps of `stepMetres` (the coarsest
/// voxel's edge). On level ground the cube's centre is at y = 0. Throws std::invalid_argument unless 0 < stepMetres ≤
/// edgeMetres.
[[nodiscard]] glm::dvec3 octreeWorldOrigin(const glm::dvec3& centre, double edgeMetres, double stepMetres);

}  // namespace dustbench::octree
