// Draws text and resamples images, with OpenImageIO.
//
// Text is ASCII. (OpenImageIO 2.4 decodes other UTF-8 characters wrongly: `…` becomes `&`.)
// Units: pixels. Threads: pure.
#pragma once

#include <string>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"
#include "methods/kit/pictures/picture_library.h"

namespace dustbench::bench {

/// A font's name or file, and its nominal height.
struct Font {
    std::string name;
    int pixels = 0;
};

/// Bounding box of a line's ink, relative to the pen's start on the baseline; y runs down.
using InkExtent = pictures::InkBox;

/// All zero for text without ink. Throws InputError if the font does not exist.
[[nodiscard]] InkExtent inkExtent(const std::string& line, const Font& font);
/// Vertical extent of any line of ASCII text.
[[nodiscard]] InkExtent lineExtent(const Font& font);

/// Covered share of each pixel: 0..1. The plane has the size given by inkExtent().
[[nodiscard]] Plane inkCoverage(const std::string& line, const Font& font);

/// The image at another size, filtered in linear light with a Blackman–Harris window. It has no negative lobes, so
/// edges get no halos and values stay within the image's range. At its own size the image is returned unchanged.
[[nodiscard]] pictures::Image resampled(const pictures::Image& image, int width, int height);

}  // namespace dustbench::bench
