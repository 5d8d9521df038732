// Writes an extinction grid as VTK image data with cell data `extinction` (floats, per metre), and a method's own grid
// with all its fields as cell data, unresampled.
#pragma once

#include <filesystem>

#include "bench/export/extinction_grid.h"
#include "bench/export/vtk_file.h"

namespace dustbench::bench {

/// Written completely or not at all. Throws InputError if it cannot be written.
void writeVti(const ExtinctionGrid& grid, const FileOrigin& origin, const std::filesystem::path& file);
/// The unit of field `x` is stored as field data `x_unit`.
void writeGridVti(const CollectedGrid& grid, const FileOrigin& origin, const std::filesystem::path& file);

}  // namespace dustbench::bench
