// What the ground looks like from near and from far: two seamless tiles of packed dirt with gravel, made from noise.
//
// The first holds grains and stones as albedo with the relief's own light and shade in it; the second holds patches of
// tens of metres, so that the first one's repetition is not seen.
// Units: metres. Deterministic: the same tiles for the same arguments. Threads: pure.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace dustbench::draw {

inline constexpr int detailTexels = 512;
inline constexpr double detailTileMetres = 4;
inline constexpr int patchTexels = 512;
/// A whole number of detail tiles, so that one phase serves both.
inline constexpr double patchTileMetres = 256;

/// RGBA, sRGB encoded; the mean in linear light is `albedo`. `toSun` lights the relief.
[[nodiscard]] std::vector<std::uint8_t> makeGroundDetail(glm::vec3 albedo, glm::vec3 toSun);

/// RGBA, linear: factors of the albedo, 128 for one.
[[nodiscard]] std::vector<std::uint8_t> makeGroundPatches();

}  // namespace dustbench::draw
