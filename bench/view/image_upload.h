// Uploads images computed on the CPU to textures. Rows from the top become rows from the bottom.
//
// Threads: the device's.
#pragma once

#include <span>

#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Uploads into a texture of the image's size: unchanged into rgba32F, display-encoded and opaque into rgba8.
void upload(const pictures::Image& image, gpu::Texture& texture);
/// Uploads one number per pixel into a texture with one channel.
void uploadRows(std::span<const float> values, gpu::Texture& texture);

}  // namespace dustbench::bench
