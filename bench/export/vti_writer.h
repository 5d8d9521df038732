// Writes an extinction grid as VTK image data: cell data `extinction`, floats per metre; and a method's own grid with
// all of its fields as cell data, cell by cell as the method has them.
#pragma once

#include <filesystem>

#include "bench/export/extinction_grid.h"

namespace dustbench::bench {

/// Whole or not at all. Throws InputError where it cannot be written.
void writeVti(const ExtinctionGrid& grid, double timeSeconds, const std::filesystem::path& file);
/// The unit of field `x` is the field data `x_unit`.
void writeGridVti(const CollectedGrid& grid, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
