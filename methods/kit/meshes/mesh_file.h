// Reads triangle meshes from OBJ, PLY and STL files, either completely or not at all
// (reports/decisions/0015-mesh-files.md).
//
// Units: as in the file. Colours: linear RGB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>

#include "methods/contract/solid.h"
#include "methods/kit/meshes/morph_mesh.h"

namespace dustbench::meshes {

/// A polygon of n corners becomes n − 2 triangles. Computes missing normals, keeping creases above 35 degrees. Uses the
/// vertex or face colours of a PLY file (8 bit, sRGB), otherwise `colour`. Limits: kit/files/limits.h. Throws
/// InputError with the file and the reason.
[[nodiscard]] DUSTBENCH_API scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour);

/// The same with morph targets: files with the same polygons but different positions. Throws InputError for others.
[[nodiscard]] DUSTBENCH_API MorphMesh readMorphMesh(const std::filesystem::path& file,
                                                    std::span<const std::filesystem::path> targets,
                                                    const glm::vec3& colour);

}  // namespace dustbench::meshes
