#include "bench/measure/image/picture.h"

#include "bench/measure/image/image_check.h"
#include "methods/kit/parallel/for_each_block.h"

namespace dustbench::bench {

Picture preparePicture(const pictures::Image& image, const std::string& name) {
    requireFinite(image, name);
    requireOpaque(image, name);
    Picture picture{name, image.width, image.height, {}, {}, Plane(image.width, image.height)};
    picture.linear.fill(picture.luma);
    picture.encoded.fill(picture.luma);
    parallel::forEachBlock(image.pixels.size(), 4096, [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const float value = image.pixels[i][static_cast<int>(channel)];
                picture.linear[channel].values[i] = value;
                picture.encoded[channel].values[i] = maths::encodeSrgb(value);
            }
            picture.luma.values[i] = 0.2126f * picture.encoded[0].values[i] + 0.7152f * picture.encoded[1].values[i] +
                                     0.0722f * picture.encoded[2].values[i];
        }
    });
    return picture;
}

void requireSameSize(const Picture& picture, const Picture& other) {
    requireSameSize(picture.width, picture.height, picture.name, other.width, other.height, other.name);
}

}  // namespace dustbench::bench
