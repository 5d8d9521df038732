// Reads a shape from TOML. data/shapes/car.toml documents its keys.
#pragma once

#include "methods/kit/files/toml_reader.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Throws InputError with file, line, the value read and the expected values.
[[nodiscard]] Shape readShape(const std::filesystem::path& file);
/// Reads an edit of the shape file `from`. Looks for its mesh next to that file, then in the data folder.
[[nodiscard]] VoxelEdit readEdit(files::TomlReader& table, const std::filesystem::path& from);

}  // namespace dustbench::voxel_shape
