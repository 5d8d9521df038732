// Triangle meshes from OBJ, PLY and STL files, which are read either completely or not at all
// (reports/decisions/0015-mesh-files.md): at rest, deforming between targets, and whether they are closed.
//
// Units: as in the file; seconds. Frame: the mesh's. Colours: linear RGB. Threads: pure.
// Source: Crane2007, 30.2.4, which interpolates the velocities of an animated mesh's vertices.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

/// A polygon of n corners becomes n − 2 triangles. Computes missing normals, keeping creases above 35 degrees. Uses the
/// vertex or face colours of a PLY file (8 bit, sRGB), otherwise `colour`. Limits: kit/files/limits.h. Throws
/// InputError with the file and the reason.
[[nodiscard]] DUSTBENCH_API scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour);

/// A mesh that deforms: each target has an offset for every vertex, and weights blend the targets.
struct MorphMesh {
    scene::Mesh rest;
    std::vector<std::vector<glm::vec3>> offsets;  ///< per target and vertex, to its position in the target
};

/// As readMesh, with morph targets: files with the same polygons but different positions. Throws InputError for others.
[[nodiscard]] DUSTBENCH_API MorphMesh readMorphMesh(const std::filesystem::path& file,
                                                    std::span<const std::filesystem::path> targets,
                                                    const glm::vec3& colour);

/// The mesh at one moment: p = p₀ + Σ wₜ·dₜ and v = Σ ẇₜ·dₜ, with recomputed normals; `weights` and `weightsPerSecond`
/// by target.
[[nodiscard]] DUSTBENCH_API scene::DeformedMesh deformed(const MorphMesh& morph, std::span<const double> weights,
                                                         std::span<const double> weightsPerSecond);

/// Edges that belong to an odd number of triangles; corners at the same place count as one. 0 for a closed surface.
[[nodiscard]] DUSTBENCH_API std::size_t openEdges(const scene::Mesh& mesh);

}  // namespace dustbench::meshes
