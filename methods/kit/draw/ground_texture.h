// Textures of the ground, near and far: two seamless noise-based tiles of packed dirt with gravel.
//
// The first contains grains and stones as albedo with the relief's shading baked in. The second contains patches of
// tens of metres, which hide the repetition of the first.
// Units: metres. Deterministic: the same arguments give the same tiles. Threads: pure.
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

/// RGBA, sRGB encoded; the mean in linear light is `albedo`. `toSun` gives the direction of the light on the relief.
[[nodiscard]] std::vector<std::uint8_t> makeGroundDetail(glm::vec3 albedo, glm::vec3 toSun);

/// RGBA, linear: factors of the albedo; 128 stands for 1.
[[nodiscard]] std::vector<std::uint8_t> makeGroundPatches();

}  // namespace dustbench::draw
