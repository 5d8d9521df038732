// How many primitives a method draws for each pixel of dust: the price of its picture.
//
// Units: primitives per pixel. Threads: pure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bench/measure/image/plane.h"
#include "bench/measure/image/screen_primitive.h"

namespace dustbench::bench {

/// Primitives by pixels with R > 0.01: 0 or more. Empty where there are none. All primitives count that were handed to
/// the GPU, those out of view too.
[[nodiscard]] std::optional<double> quadsPerPixel(std::int64_t primitives, const Plane& referenceAlpha);

/// Its map: how many quads (half side 1.5 r) cover a pixel's centre.
[[nodiscard]] Plane overdrawMap(std::span<const ScreenPrimitive> primitives, int width, int height);

}  // namespace dustbench::bench
