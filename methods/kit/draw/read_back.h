// Reads textures back from the GPU as images and depths.
//
// Rows from the top. Threads: the device's thread. Each call waits for the GPU.
#pragma once

#include <vector>

#include "methods/kit/pictures/image.h"

namespace dustbench::gpu {
class Texture;
}

namespace dustbench::draw {

/// Reads a 2D texture of four channels; values as stored. Throws std::invalid_argument for any other texture.
[[nodiscard]] DUSTBENCH_API pictures::Image readBack(const gpu::Texture& texture);

/// Reads the depths of a 2D Depth32F texture. Throws std::invalid_argument for any other texture.
[[nodiscard]] DUSTBENCH_API std::vector<float> readBackDepth(const gpu::Texture& texture);

}  // namespace dustbench::draw
