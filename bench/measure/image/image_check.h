// What every image must be before a metric may look at it: some pixels, all finite, the sizes equal, opaque or with an
// alpha as is expected.
//
// All throw InputError with one line that names the image: a file, or the part that it plays.
#pragma once

#include <string_view>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Alpha may differ from 1, or leave [0, 1], by so much: a layer over a scene adds up to 1 only within rounding.
inline constexpr float alphaTolerance = 1e-3f;

/// Pixels that are not finite in any of the four channels are counted, and the first is named.
void requireFinite(const pictures::Image& image, std::string_view name);
void requireFinite(const Plane& plane, std::string_view name);

void requireOpaque(const pictures::Image& image, std::string_view name);

void requireSameSize(int width, int height, std::string_view name, int otherWidth, int otherHeight,
                     std::string_view otherName);
void requireSameSize(const Plane& plane, std::string_view name, const Plane& other, std::string_view otherName);

/// The alpha of a layer, checked to lie in [0, 1] but for the tolerance, and clamped.
[[nodiscard]] Plane alphaOf(const pictures::Image& layer, std::string_view name);

}  // namespace dustbench::bench
