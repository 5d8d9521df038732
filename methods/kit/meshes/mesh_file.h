// Reads triangle meshes from OBJ, PLY and STL files, all of a file or none of it
// (reports/decisions/0015-mesh-files.md).
//
// Units: as in the file. Colours: linear RGB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

/// A polygon of n corners becomes n − 2 triangles. Computes missing normals, keeping creases above 35 degrees. Uses the
/// vertex or face colours of a PLY file (8 bit, sRGB), else `colour`. Limits: kit/files/limits.h. Throws InputError
/// with the file and the reason.
[[nodiscard]] DUSTBENCH_API scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour);

}  // namespace dustbench::meshes
