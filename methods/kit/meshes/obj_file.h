// Reads the polygons of an OBJ file: v, vn and f. Texture coordinates, groups, materials, points and lines are checked
// or skipped. Free-form surfaces and unknown keywords are errors, because the mesh would be incomplete.
//
// Format: Wavefront, Advanced Visualizer, Appendix B1 (object files). The comment `# counts: v 642, f 1280` is our
// extension: it gives the number of lines of each kind, so that a file truncated between two lines is detected.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/kit/meshes/polygons.h"

namespace dustbench::meshes {

/// Normals are used if every face names one for each corner; positions are then pairs of vertex and normal. Throws
/// InputError with file and line.
[[nodiscard]] Polygons readObj(std::string_view text, const std::filesystem::path& file);

}  // namespace dustbench::meshes
