// Primitives drawn per pixel of dust: the cost of the picture.
//
// Units: primitives per pixel. Threads: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bench/measure/image/plane.h"
#include "bench/measure/image/screen_primitive.h"

namespace dustbench::bench {

/// Primitives divided by the number of pixels with R > 0.01: 0 or more. Empty if there are no such pixels. Counts all
/// primitives handed to the GPU, including those out of view.
[[nodiscard]] std::optional<double> quadsPerPixel(std::int64_t primitives, const Plane& referenceAlpha);

/// The map: the number of quads (half side 1.5 r) that cover each pixel's centre.
[[nodiscard]] Plane overdrawMap(std::span<const ScreenPrimitive> primitives, int width, int height);

}  // namespace dustbench::bench
