// Reads the polygons of an OBJ file: v, vn and f. Texture coordinates, groups, materials, points and lines are checked
// or passed over; free-form surfaces and unknown keywords are errors, because something would be missing.
//
// Format: Wavefront, Advanced Visualizer, Appendix B1 (object files). A comment `# counts: v 642, f 1280` is ours: it
// says how many lines of each kind the file has, which makes a file that is cut between two lines an error.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/kit/meshes/polygons.h"

namespace dustbench::meshes {

/// Normals are used if every face names one for each corner; positions are then pairs of vertex and normal. Throws
/// InputError with file and line.
[[nodiscard]] Polygons readObj(std::string_view text, const std::filesystem::path& file);

}  // namespace dustbench::meshes
