// Mip levels of 8-bit pictures, computed on the CPU, so that they are equal on all devices. Drivers round their own
// differently: an NVIDIA driver made an sRGB ground 1 % less blue than Mesa.
//
// Values: tightly packed, row by row, 1 or 4 channels. Units: bytes; with `srgb`, the first three channels are encoded.
// Threads: any.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace dustbench::gpu {

struct MipLevel {
    int width = 0, height = 0;
    std::vector<std::uint8_t> values;
};

/// Levels 1 to the last, which has one texel; a side of n texels has max(⌊n/2⌋, 1) in the next level. A texel is the
/// mean of the area that it covers, of light rather than of encoded values, and is rounded once.
[[nodiscard]] std::vector<MipLevel> mipLevelsOf(std::span<const std::uint8_t> values, int width, int height,
                                                int channels, bool srgb);

}  // namespace dustbench::gpu
