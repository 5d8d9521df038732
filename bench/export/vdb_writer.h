// Writes an extinction grid as an OpenVDB fog volume `density`, per metre, and a method's own grid as one OpenVDB grid
// per field.
//
// OpenVDB's voxels are samples at nodes: the transform puts each at its cell's centre, origin + spacing/2.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/export/extinction_grid.h"

namespace dustbench::bench {

enum class VdbPrecision { half, single };

/// Sparse: cells without extinction are not stored. Written completely or not at all. Throws InputError if the file
/// cannot be written, or if half floats cannot represent the maximum value.
void writeVdb(const ExtinctionGrid& grid, VdbPrecision precision, std::int64_t frame, double timeSeconds,
              const std::filesystem::path& file);

/// Sparse: zeros are not stored. Single precision; the unit is stored as metadata `unit`.
void writeGridVdb(const CollectedGrid& grid, std::int64_t frame, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
