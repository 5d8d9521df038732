// Reads triangle meshes from OBJ, PLY and STL files through VTK's readers.
//
// Units: as in the file. Colours: linear RGB.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "methods/contract/solid.h"

namespace dustbench::meshes {

/// Triangulates polygons; computes missing normals, keeping creases above 35 degrees. Uses the vertex or face colours
/// of a PLY file (8 bit, sRGB), else `colour`. Throws InputError with the file and the reason.
[[nodiscard]] DUSTBENCH_API scene::Mesh readMesh(const std::filesystem::path& file, const glm::vec3& colour);

}  // namespace dustbench::meshes
