// A mesh that deforms: each target has an offset for every vertex, and weights blend the targets.
//
// Units: metres, seconds. Frame: the mesh's. Threads: pure.
// Source: Crane2007, 30.2.4, which interpolates the velocities of an animated mesh's vertices.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

struct MorphMesh {
    scene::Mesh rest;
    std::vector<std::vector<glm::vec3>> offsets;  ///< per target and vertex, to its position in the target
};

/// p = p₀ + Σ wₜ·dₜ and v = Σ ẇₜ·dₜ, with recomputed normals; `weights` and `weightsPerSecond` by target.
[[nodiscard]] DUSTBENCH_API scene::DeformedMesh deformed(const MorphMesh& morph, std::span<const double> weights,
                                                         std::span<const double> weightsPerSecond);

}  // namespace dustbench::meshes
