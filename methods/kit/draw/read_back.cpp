#include "methods/kit/draw/read_back.h"

#include <algorithm>
#include <stdexcept>

#include "methods/kit/gpu/texture.h"

namespace dustbench::draw {

pictures::Image readBack(const gpu::Texture& texture) {
    const bool fourChannels = texture.format() == gpu::Format::rgba8 || texture.format() == gpu::Format::srgba8 ||
                              texture.format() == gpu::Format::rgba16F || texture.format() == gpu::Format::rgba32F;
    if (!fourChannels || texture.depth() != 1)
        throw std::invalid_argument("readBack: expected a 2D texture with four channels");
    const std::vector<float> values = texture.readFloats();
    pictures::Image image{texture.width(), texture.height(), std::vector<glm::vec4>(values.size() / 4)};
    const auto row = static_cast<std::size_t>(image.width);
    const auto rows = static_cast<std::size_t>(image.height);
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < row; ++x) {
            const float* value = &values[((rows - 1 - y) * row + x) * 4];
            image.pixels[y * row + x] = {value[0], value[1], value[2], value[3]};
        }
    return image;
}

std::vector<float> readBackDepth(const gpu::Texture& texture) {
    if (texture.format() != gpu::Format::depth32F || texture.depth() != 1)
        throw std::invalid_argument("readBackDepth: expected a 2D texture of depths");
    std::vector<float> depths = texture.readFloats();
    const std::ptrdiff_t width = texture.width(), height = texture.height();
    for (std::ptrdiff_t y = 0; y < height / 2; ++y)
        std::swap_ranges(depths.begin() + y * width, depths.begin() + (y + 1) * width,
                         depths.begin() + (height - 1 - y) * width);
    return depths;
}

}  // namespace dustbench::draw
