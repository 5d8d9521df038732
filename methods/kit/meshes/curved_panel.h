// The face of a curved panel, and the frame of its relief.
//
//     S(x, y)    = (x, y, −½·(kx·x² + ky·y²))        the face, in the panel's frame
//     P(x, y, z) = S(x, y) + z·n(x, y)               n: the face's unit normal
//
// (x, y, z) is a place in the relief's frame, P the same place in the panel's. x and y are lengths along the face's
// projection: along the face itself they are longer by √(1 + slope²). A panel without curvature has one frame for both.
//
// Units: m, 1/m. Threads: pure. Source: Oliveira2005 (reliefs on quadrics).
#pragma once

#include <glm/glm.hpp>

#include "methods/contract/scene.h"

namespace dustbench::meshes {

[[nodiscard]] inline bool isCurved(const scene::Panel& panel) {
    return panel.curvaturePerMetre != glm::dvec2(0);
}

/// P of a place in the relief's frame.
[[nodiscard]] DUSTBENCH_API glm::dvec3 fromRelief(const scene::Panel& panel, const glm::dvec3& relief);
/// The inverse, by Newton's method, for places close to the face: a fraction of the radius of curvature.
[[nodiscard]] DUSTBENCH_API glm::dvec3 toRelief(const scene::Panel& panel, const glm::dvec3& place);
/// ∂P/∂x, ∂P/∂y and ∂P/∂z = n, as columns: velocities in the panel's frame are this matrix times those in the relief's.
[[nodiscard]] DUSTBENCH_API glm::dmat3 reliefAxes(const scene::Panel& panel, const glm::dvec3& relief);

struct PlateBounds {
    glm::dvec3 low, high;
};
/// A box around the plate, in the panel's frame.
[[nodiscard]] DUSTBENCH_API PlateBounds boundsOf(const scene::Panel& panel);

}  // namespace dustbench::meshes
