// Reads a height field from an image.
#pragma once

#include <filesystem>

#include "methods/contract/terrain.h"

namespace dustbench::bench {

/// Uses the first channel as stored (no colour decoding): black is `baseMetres`, white is `heightMetres` above. One
/// sample per pixel, `spacingMetres` apart, with the image's centre at the world's origin and its top row at minimum z.
/// Throws InputError with the file and the reason.
[[nodiscard]] scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres,
                                             double heightMetres, double baseMetres);

}  // namespace dustbench::bench
