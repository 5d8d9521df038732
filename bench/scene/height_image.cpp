#include "bench/scene/height_image.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <string>
#include <vector>

#include "methods/shared/errors.h"

namespace dustbench::bench {

scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres, double heightMetres,
                               double baseMetres) {
    const auto image = OIIO::ImageInput::open(file.string());
    if (!image) throw InputError(file.string() + ": not an image that can be read: " + OIIO::geterror());
    const OIIO::ImageSpec& spec = image->spec();
    if (spec.width < 2 || spec.height < 2 || spec.width > 8192 || spec.height > 8192)
        throw InputError(file.string() + ": the height field has " + std::to_string(spec.width) + " x " +
                         std::to_string(spec.height) + " pixels, expected 2..8192 a side");
    std::vector<float> heights(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    if (!image->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, heights.data()))
        throw InputError(file.string() + ": the image cannot be read: " + image->geterror());
    for (float& height : heights) {
        if (!std::isfinite(height)) throw InputError(file.string() + ": a height is not a finite number");
        height = static_cast<float>(baseMetres + heightMetres * static_cast<double>(height));
    }
    const auto firstOf = [&](int samples) { return static_cast<float>(-0.5 * spacingMetres * (samples - 1)); };
    return {std::move(heights),  spec.width,          spec.height, static_cast<float>(spacingMetres),
            firstOf(spec.width), firstOf(spec.height)};
}

}  // namespace dustbench::bench
