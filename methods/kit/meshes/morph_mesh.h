// A mesh that changes its shape: each of its targets moves its vertices by a share of an offset of their own.
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
    std::vector<std::vector<glm::vec3>> offsets;  ///< of each target, for each vertex: to where it has it
};

/// p = p₀ + Σ wₜ·dₜ and v = Σ ẇₜ·dₜ, with normals computed anew; `weights` and `weightsPerSecond` by target.
[[nodiscard]] DUSTBENCH_API scene::DeformedMesh deformed(const MorphMesh& morph, std::span<const double> weights,
                                                         std::span<const double> weightsPerSecond);

}  // namespace dustbench::meshes
