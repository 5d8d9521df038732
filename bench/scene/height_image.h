// Reads a height field from an image.
#pragma once

#include <filesystem>

#include "methods/contract/terrain.h"

namespace dustbench::bench {

/// The first channel, taken as stored (no colour encoding): black at `baseMetres`, white `heightMetres` above. One
/// sample a pixel, `spacingMetres` apart, the image's middle at the world's origin, its top row at the minimum z.
/// Throws InputError with the file and the reason.
[[nodiscard]] scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres,
                                             double heightMetres, double baseMetres);

}  // namespace dustbench::bench
