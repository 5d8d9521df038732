#include "bench/view/image_upload.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace dustbench::bench {
namespace {

/// `values`, `count` of them to a row, with the last row first.
template <typename Value>
std::vector<Value> upsideDown(std::span<const Value> values, std::size_t count) {
    std::vector<Value> turned;
    turned.reserve(values.size());
    for (std::size_t end = values.size(); end >= count && count > 0; end -= count)
        turned.insert(turned.end(), values.begin() + static_cast<std::ptrdiff_t>(end - count),
                      values.begin() + static_cast<std::ptrdiff_t>(end));
    return turned;
}

std::vector<std::uint8_t> encoded(const pictures::Image& image) {
    std::vector<std::uint8_t> values;
    values.reserve(4 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            values.push_back(static_cast<std::uint8_t>(std::lround(255 * pictures::encodeSrgb(pixel[channel]))));
        values.push_back(255);
    }
    return values;
}

std::vector<float> flat(const pictures::Image& image) {
    std::vector<float> values;
    values.reserve(4 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) values.insert(values.end(), {pixel.r, pixel.g, pixel.b, pixel.a});
    return values;
}

}  // namespace

void upload(const pictures::Image& image, gpu::Texture& texture) {
    const auto row = 4 * static_cast<std::size_t>(image.width);
    if (texture.format() == gpu::Format::rgba8) {
        const std::vector<std::uint8_t> values = upsideDown<std::uint8_t>(encoded(image), row);
        texture.write(std::span<const std::uint8_t>(values));
    } else {
        const std::vector<float> values = upsideDown<float>(flat(image), row);
        texture.write(std::span<const float>(values));
    }
}

void uploadRows(std::span<const float> values, gpu::Texture& texture) {
    const std::vector<float> turned = upsideDown<float>(values, static_cast<std::size_t>(texture.width()));
    texture.write(std::span<const float>(turned));
}

}  // namespace dustbench::bench
