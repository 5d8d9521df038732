// Reads a shape from TOML. data/shapes/car.toml is the manual of its keys.
#pragma once

#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {

/// Throws InputError with file, line, what was got and what is expected.
[[nodiscard]] Shape readShape(const std::filesystem::path& file);

}  // namespace dustbench::voxel_shape
