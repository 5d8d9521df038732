// A shape's voxels as VTK image data (.vti), to view and edit in other programs and to read again.
//
// One cell per voxel; all attributes of Voxel as cell data in their units; the field data `dustbench_voxels` is the
// version. Written to a temporary file and renamed, so never incomplete. Threads: one caller at a time.
#pragma once

#include <filesystem>

#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

inline constexpr int voxelFileVersion = 1;

/// Throws InputError if the file cannot be written.
void writeVoxels(const VoxelGrid& grid, const std::filesystem::path& file);

/// Reads voxels; densities are 0, since particles are not saved. Throws InputError with the file and the fault: not
/// such a file, truncated, another version, an attribute missing or out of range.
[[nodiscard]] VoxelGrid readVoxels(MemoryLedger& ledger, const std::filesystem::path& file);

}  // namespace dustbench::voxel_shape
