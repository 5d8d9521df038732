// FLIP: how strongly somebody who flips between two pictures sees them differ, pixel by pixel.
//
// The pictures are blurred as far as the eye blurs them at the given distance; what is left differs in colour by ΔE_c
// in [0, 1]. Edges and points that one picture has and the other has not differ by ΔE_f in [0, 1] and raise it:
//
//     ΔE = ΔE_c ^ (1 − ΔE_f)
//
// The variant for displays of low dynamic range: linear light is clamped to [0, 1] first.
// Units: pixels per degree of the field of view. Threads: uses the current oneTBB arena; the same at any number of
// threads. Source: Andersson2020, sections 4 and 5.
#pragma once

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

/// A display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double defaultPixelsPerDegree = 67.02;
inline constexpr double minimumPixelsPerDegree = 1, maximumPixelsPerDegree = 1000;

/// Mean of the map: 0..1, 0 for identical pictures. The map has the pictures' size, 0..1.
/// Throws InputError for different sizes, or pixels per degree that are out of range.
[[nodiscard]] Measured flip(const Picture& reference, const Picture& picture,
                            double pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace dustbench::bench
