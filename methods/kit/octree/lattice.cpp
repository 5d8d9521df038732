#include "methods/kit/octree/lattice.h"

#include <stdexcept>

namespace dustbench::octree {

glm::dvec3 octreeWorldOrigin(const glm::dvec3& centre, double edgeMetres, double stepMetres) {
    if (!(stepMetres > 0) || !(stepMetres <= edgeMetres))
        throw std::invalid_argument("octreeWorldOrigin: the step must be positive and at most the edge");
    return glm::floor(centre / stepMetres + 0.5) * stepMetres - edgeMetres / 2;
}

}  // namespace dustbench::octree
