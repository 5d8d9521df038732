#include "methods/kit/pictures/image.h"

#include <stdexcept>

namespace dustbench::pictures {

Image over(const Image& layer, const Image& scene) {
    if (layer.width != scene.width || layer.height != scene.height)
        throw std::invalid_argument("over: the layer and the scene differ in size");
    Image result = layer;
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        result.pixels[i] += (1 - layer.pixels[i].a) * scene.pixels[i];
    return result;
}

Image decoded(Image image) {
    for (glm::vec4& pixel : image.pixels)
        pixel = {decodeSrgb(pixel.r), decodeSrgb(pixel.g), decodeSrgb(pixel.b), pixel.a};
    return image;
}

}  // namespace dustbench::pictures
