#include "bench/sheet/raster.h"

#include <fmt/format.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <stdexcept>

#include "methods/shared/errors.h"

namespace dustbench::bench {
namespace {

constexpr int oneThread = 1;

OIIO::ROI flatRegion(int width, int height, int channels) {
    return {0, width, 0, height, 0, 1, 0, channels};
}

}  // namespace

InkExtent inkExtent(const std::string& line, const Font& font) {
    const OIIO::ROI ink = OIIO::ImageBufAlgo::text_size(line, font.pixels, font.name);
    if (!ink.defined())
        throw InputError(
            fmt::format("cannot find the font '{}': expected one that is installed, or a font's file; "
                        "Debian's package fonts-dejavu-core brings DejaVuSans and DejaVuSans-Bold",
                        font.name));
    if (ink.xbegin >= ink.xend) return {};
    return {ink.xbegin, ink.xend, ink.ybegin, ink.yend};
}

InkExtent lineExtent(const Font& font) {
    return inkExtent("()[]{}|/\\@$_,;'\"^`gjpqyJQbdfhklt", font);  // what reaches highest and lowest in any font
}

Plane inkCoverage(const std::string& line, const Font& font) {
    const InkExtent extent = inkExtent(line, font);
    Plane coverage(extent.width(), extent.height());
    if (coverage.values.empty()) return coverage;
    // White on black leaves the coverage itself.
    OIIO::ImageBuf buffer(OIIO::ImageSpec(coverage.width, coverage.height, 1, OIIO::TypeDesc::FLOAT),
                          coverage.values.data());
    if (!OIIO::ImageBufAlgo::render_text(buffer, -extent.left, -extent.top, line, font.pixels, font.name, 1.0f,
                                         OIIO::ImageBufAlgo::TextAlignX::Left, OIIO::ImageBufAlgo::TextAlignY::Baseline,
                                         0, {}, oneThread))
        throw InputError("cannot draw text: " + buffer.geterror());
    return coverage;
}

draw::Image resampled(const draw::Image& image, int width, int height) {
    if (width < 1 || height < 1 || image.width < 1 || image.height < 1)
        throw std::invalid_argument("resampled: an image has one pixel at least");
    if (width == image.width && height == image.height) return image;
    draw::Image source = image;  // OpenImageIO wraps memory that it may write to
    draw::Image result{width, height, {}};
    result.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const OIIO::ImageBuf from(OIIO::ImageSpec(source.width, source.height, 4, OIIO::TypeDesc::FLOAT),
                              source.pixels.data());
    OIIO::ImageBuf to(OIIO::ImageSpec(width, height, 4, OIIO::TypeDesc::FLOAT), result.pixels.data());
    if (!OIIO::ImageBufAlgo::resize(to, from, "blackman-harris", 0.0f, flatRegion(width, height, 4), oneThread))
        throw std::runtime_error("cannot resample an image: " + to.geterror());
    return result;
}

}  // namespace dustbench::bench
