// Lettering and resampling, by OpenImageIO.
//
// Text is ASCII. (OpenImageIO 2.4 takes other letters of UTF-8 for wrong ones: `…` comes out as `&`.)
// Units: pixels. Threads: pure.
#pragma once

#include <string>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::bench {

/// A font's name, or its file, and the height that it is designed on.
struct Font {
    std::string name;
    int pixels = 0;
};

/// What a line's ink lies within, seen from the pen's start on the baseline; y runs down.
using InkExtent = pictures::InkBox;

/// All zero for text without ink. Throws InputError where there is no such font.
[[nodiscard]] InkExtent inkExtent(const std::string& line, const Font& font);
/// The same for any line of ASCII, above and below the baseline alone.
[[nodiscard]] InkExtent lineExtent(const Font& font);

/// Which share of each pixel is covered: 0..1. The plane is as large as inkExtent() says.
[[nodiscard]] Plane inkCoverage(const std::string& line, const Font& font);

/// The image at another size, filtered in linear light by a Blackman-Harris window: it has no negative lobes, so that
/// edges get no halos and no value leaves the image's own range. At its own size the image is returned as it is.
[[nodiscard]] pictures::Image resampled(const pictures::Image& image, int width, int height);

}  // namespace dustbench::bench
