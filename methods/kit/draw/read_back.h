// Brings textures back from the GPU as images and depths.
//
// Rows from the top. Threads: the device's. Each call waits for the GPU.
#pragma once

#include <vector>

#include "methods/kit/draw/read_back.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::gpu {
class Texture;
}

namespace dustbench::draw {

/// A flat texture of four channels, values as they are stored. Throws std::invalid_argument for any other.
[[nodiscard]] DUSTBENCH_API pictures::Image readBack(const gpu::Texture& texture);

/// Depths of a flat Depth32F texture. Throws std::invalid_argument for any other.
[[nodiscard]] DUSTBENCH_API std::vector<float> readBackDepth(const gpu::Texture& texture);

}  // namespace dustbench::draw
