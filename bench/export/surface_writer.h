// Writes a surface that a method changed, as a mesh and as a picture of its heights, and textures of a method's state.
#pragma once

#include <filesystem>

#include "bench/export/collected_volume.h"
#include "bench/export/vtk_file.h"

namespace dustbench::bench {

/// Points, quadrilaterals and the points' `colour` (linear RGB), `height` and further fields, as `.vtp`. Written
/// completely or not at all. Throws InputError if it cannot be written.
void writeSurface(const CollectedSurface& surface, const FileOrigin& origin, const std::filesystem::path& file);

/// The heights as a grey `.exr`, one pixel per point, rows from the top, as for the key `heights` of a relief.
void writeHeights(const CollectedSurface& surface, const std::filesystem::path& file);

/// The four channels as RGBA of an `.exr`, as they are, rows from the top in memory's order.
void writeTexture(const CollectedTexture& texture, const std::filesystem::path& file);

}  // namespace dustbench::bench
