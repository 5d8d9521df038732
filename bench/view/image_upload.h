// Images computed on the CPU as textures; rows from the top become rows from the bottom.
//
// Threads: the device's.
#pragma once

#include <span>

#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Into a texture of the image's size: as it is into rgba32F, display-encoded and opaque into rgba8.
void upload(const pictures::Image& image, gpu::Texture& texture);
/// One number a pixel, into a texture of one channel.
void uploadRows(std::span<const float> values, gpu::Texture& texture);

}  // namespace dustbench::bench
