// Writes an extinction grid as an OpenVDB fog volume `density`, per metre; and a method's own grid as an OpenVDB grid
// for each of its fields.
//
// OpenVDB's voxels are samples at nodes: the transform puts each at its cell's centre, origin + spacing/2.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/export/extinction_grid.h"

namespace dustbench::bench {

/// Sparse: cells without extinction are not stored. Whole or not at all. Throws InputError where it cannot be written,
/// or where half floats cannot hold the largest value.
void writeVdb(const ExtinctionGrid& grid, VdbPrecision precision, std::int64_t frame, double timeSeconds,
              const std::filesystem::path& file);

/// Sparse: what is 0 is not stored. In single precision, and its units as metadata `unit`.
void writeGridVdb(const CollectedGrid& grid, std::int64_t frame, double timeSeconds, const std::filesystem::path& file);

}  // namespace dustbench::bench
