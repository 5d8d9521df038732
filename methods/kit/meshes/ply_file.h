// Reads the polygons of a PLY file, ASCII or binary, with its elements and properties in any order.
//
// Vertices have x, y, z, and may have nx, ny, nz and red, green, blue (uchar), which faces may have too; faces have the
// list vertex_indices or vertex_index. Everything else is checked and skipped.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/kit/meshes/polygons.h"

namespace dustbench::meshes {

/// The body must match the header exactly. Throws InputError with file and line, or with the element.
[[nodiscard]] Polygons readPly(std::string_view text, const std::filesystem::path& file);

}  // namespace dustbench::meshes
