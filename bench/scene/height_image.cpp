#include "bench/scene/height_image.h"

#include <cmath>
#include <string>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/pictures/picture_files.h"

namespace dustbench::bench {

scene::Terrain readHeightImage(const std::filesystem::path& file, double spacingMetres, double heightMetres,
                               double baseMetres) {
    pictures::StoredPicture image;
    const auto fail = [&](const std::string& reason) {
        throw InputError(file.string() + ": not an image that can be read: " + reason);
    };
    if (const std::string reason = pictures::readPictureSize(file, image); !reason.empty()) fail(reason);
    const auto isAllowed = [](int edge) { return edge >= 2 && edge <= files::limits::heightEdge; };
    if (!isAllowed(image.width) || !isAllowed(image.height))
        throw InputError(file.string() + ": the height field has " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " pixels, expected 2.." +
                         std::to_string(files::limits::heightEdge) + " a side");
    if (const std::string reason = pictures::readPicture(file, image); !reason.empty()) fail(reason);
    files::noteIgnored(file, pictures::unusedParts(image, 1, false));
    std::vector<float> heights(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const float share = image.values[i * static_cast<std::size_t>(image.channels)];
        if (!std::isfinite(share)) throw InputError(file.string() + ": a height is not a finite number");
        heights[i] = static_cast<float>(baseMetres + heightMetres * static_cast<double>(share));
    }
    const auto firstOf = [&](int samples) { return static_cast<float>(-0.5 * spacingMetres * (samples - 1)); };
    return {std::move(heights),   image.width,          image.height, static_cast<float>(spacingMetres),
            firstOf(image.width), firstOf(image.height)};
}

}  // namespace dustbench::bench
