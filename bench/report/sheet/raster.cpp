#include "bench/report/sheet/raster.h"

#include <fmt/format.h>

#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::bench {
InkExtent inkExtent(const std::string& line, const Font& font) {
    InkExtent ink;
    if (!pictures::pictureLibrary().findInk(line, font.pixels, font.name, ink))
        throw InputError(
            fmt::format("cannot find the font '{}': expected one that is installed, or a font's file; "
                        "Debian's package fonts-dejavu-core brings DejaVuSans and DejaVuSans-Bold",
                        font.name));
    return ink;
}

InkExtent lineExtent(const Font& font) {
    return inkExtent("()[]{}|/\\@$_,;'\"^`gjpqyJQbdfhklt", font);  // what reaches highest and lowest in any font
}

Plane inkCoverage(const std::string& line, const Font& font) {
    const InkExtent extent = inkExtent(line, font);
    Plane coverage(extent.width(), extent.height());
    if (coverage.values.empty()) return coverage;
    const std::string reason =
        pictures::pictureLibrary().drawText(line, font.pixels, font.name, extent, coverage.values);
    if (!reason.empty()) throw InputError("cannot draw text: " + reason);
    return coverage;
}

pictures::Image resampled(const pictures::Image& image, int width, int height) {
    if (width < 1 || height < 1 || image.width < 1 || image.height < 1)
        throw std::invalid_argument("resampled: an image has one pixel at least");
    if (width == image.width && height == image.height) return image;
    pictures::Image result{width, height, {}};
    result.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::string reason =
        pictures::pictureLibrary().resize({&image.pixels[0].x, image.pixels.size() * 4}, image.width, image.height,
                                          {&result.pixels[0].x, result.pixels.size() * 4}, width, height);
    if (!reason.empty()) throw std::runtime_error("cannot resample an image: " + reason);
    return result;
}

}  // namespace dustbench::bench
