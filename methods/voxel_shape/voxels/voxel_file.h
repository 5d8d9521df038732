// A shape's voxels as a file of VTK's image data (.vti), for looking at and editing elsewhere, and back.
//
// One cell a voxel, all attributes of voxel.h as cell data in their units; `dustbench_voxels` in the field data is the
// version. Written beside and renamed, so never half there. Threads: one caller at a time.
#pragma once

#include <filesystem>

#include "methods/voxel_shape/voxels/voxel_grid.h"

namespace dustbench::voxel_shape {

inline constexpr int voxelFileVersion = 1;

/// Throws InputError where the file cannot be written.
void writeVoxels(const VoxelGrid& grid, const std::filesystem::path& file);

/// Densities begin at 0: particles are not kept. Throws InputError with the file and what is wrong with it: not such a
/// file, cut short, another version, an attribute missing or out of its range.
[[nodiscard]] VoxelGrid readVoxels(MemoryLedger& ledger, const std::filesystem::path& file);

}  // namespace dustbench::voxel_shape
