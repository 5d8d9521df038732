// Writes an extinction grid as VTK image data: cell data `extinction`, floats per metre.
#pragma once

#include <filesystem>

#include "bench/export/extinction_grid.h"

namespace dustbench::bench {

/// Whole or not at all. Throws InputError where it cannot be written.
void writeVti(const ExtinctionGrid& grid, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
