// Reads the triangles of an STL file, binary or ASCII. Corners at the same point become one vertex; facet normals are
// checked but not used.
//
// Format: 3D Systems, StereoLithography Interface Specification (1988).
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/kit/meshes/polygons.h"

namespace dustbench::meshes {

/// A binary file must have exactly 84 + 50 n bytes for its n triangles; an ASCII file must end with `endsolid` and a
/// line end. Throws InputError with file and line, or with the lengths.
[[nodiscard]] Polygons readStl(std::string_view text, const std::filesystem::path& file);

}  // namespace dustbench::meshes
