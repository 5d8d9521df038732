// Checks of images before metrics use them: at least one pixel, all finite, equal sizes, opaque or with a valid alpha.
//
// All throw InputError with one line that names the image: a file, or its role.
#pragma once

#include <string_view>

#include "bench/measure/image/plane.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Tolerance of alpha around 1, and outside [0, 1]: a layer over a scene sums to 1 only within rounding.
inline constexpr float alphaTolerance = 1e-3f;

/// The message gives the number of pixels with a non-finite channel, and the first such pixel.
void requireFinite(const pictures::Image& image, std::string_view name);
void requireFinite(const Plane& plane, std::string_view name);

void requireOpaque(const pictures::Image& image, std::string_view name);

void requireSameSize(int width, int height, std::string_view name, int otherWidth, int otherHeight,
                     std::string_view otherName);
void requireSameSize(const Plane& plane, std::string_view name, const Plane& other, std::string_view otherName);

/// The alpha of a layer: checked to lie in [0, 1] within the tolerance, then clamped.
[[nodiscard]] Plane alphaOf(const pictures::Image& layer, std::string_view name);

}  // namespace dustbench::bench
