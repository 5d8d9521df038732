#include "bench/measure/image/resampled.h"

#include <stdexcept>
#include <string>

#include "methods/kit/pictures/picture_library.h"

namespace dustbench::measure {

pictures::Image resampled(const pictures::Image& image, int width, int height) {
    if (width < 1 || height < 1 || image.width < 1 || image.height < 1)
        throw std::invalid_argument("resampled: an image has at least one pixel");
    if (width == image.width && height == image.height) return image;
    pictures::Image result{width, height, {}};
    result.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::string reason =
        pictures::pictureLibrary().resize({&image.pixels[0].x, image.pixels.size() * 4}, image.width, image.height,
                                          {&result.pixels[0].x, result.pixels.size() * 4}, width, height);
    if (!reason.empty()) throw std::runtime_error("an image cannot be resampled: " + reason);
    return result;
}

}  // namespace dustbench::measure
