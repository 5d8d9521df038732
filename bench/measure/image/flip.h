// FLIP: the difference that a viewer perceives when flipping between two pictures, per pixel.
//
// The pictures are filtered by the eye's contrast sensitivity at the given viewing distance; the remaining colour
// difference is ΔE_c in [0, 1]. Edges and points that occur in only one picture give ΔE_f in [0, 1], which raises it:
//
//     ΔE = ΔE_c ^ (1 − ΔE_f)
//
// This is the variant for low-dynamic-range displays: linear light is first clamped to [0, 1].
// Units: pixels per degree of the field of view. Threads: uses the current oneTBB arena; the same at any number of
// threads. Source: Andersson2020, sections 4 and 5.
#pragma once

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

/// A display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double defaultPixelsPerDegree = 67.02;
inline constexpr double minimumPixelsPerDegree = 1, maximumPixelsPerDegree = 1000;

/// Mean of the map: 0..1, 0 for identical pictures. The map has the size of the pictures, values 0..1. Throws
/// InputError if the sizes differ or the pixels per degree are out of range.
[[nodiscard]] Measured flip(const Picture& reference, const Picture& picture,
                            double pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace dustbench::bench
