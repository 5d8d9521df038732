// Resamples images, with OpenImageIO.
//
// Units: pixels. Threads: pure.
#pragma once

#include "methods/kit/pictures/image.h"

namespace dustbench::measure {

/// The image at another size, filtered in linear light with a Blackman–Harris window. It has no negative lobes, so
/// edges get no halos and values stay within the image's range. At its own size the image is returned unchanged.
/// Throws std::invalid_argument for sizes below one pixel.
[[nodiscard]] pictures::Image resampled(const pictures::Image& image, int width, int height);

}  // namespace dustbench::measure
