// An opaque picture prepared for the metrics: checked and display-encoded once.
//
// Units: display-encoded sRGB values in [0, 1]; `linear` is as given, so it may be below 0 or above 1.
// Threads: preparation uses the current oneTBB arena; the result is bit-identical at any number of threads.
#pragma once

#include <array>
#include <string>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

struct Picture {
    std::string name;  ///< for messages: a file, or its role
    int width = 0;
    int height = 0;
    std::array<Plane, 3> linear;   ///< red, green, blue
    std::array<Plane, 3> encoded;  ///< of `linear` clamped to [0, 1]
    Plane luma;                    ///< 0.2126 R + 0.7152 G + 0.0722 B of the encoded values (Rec. 709)
};

/// Throws InputError if it has no pixels, or some are not finite or not opaque.
[[nodiscard]] Picture preparePicture(const pictures::Image& image, const std::string& name);

/// Throws InputError.
void requireSameSize(const Picture& picture, const Picture& other);

}  // namespace dustbench::bench
