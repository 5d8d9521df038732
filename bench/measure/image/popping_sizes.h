// Popping of small and of large primitives separately, within one picture: whether large voxels pop more than small
// ones, and which of them contribute more to the popping of the picture.
//
// A primitive is large if it is larger, in metres, than the geometric mean of the smallest and the largest one. A pixel
// belongs to the side whose primitives have more optical depth there, summed over the two frames. A primitive
// contributes depth·exp(−2b²/r²) within 1.5 r, the extent of a drawn quad, whether the scene hides it or not.
//
//     small, large            popping over the pixels of that side only: how much they jump
//     small_part, large_part  √(Σ jump² over the side's pixels / number of pixels with dust): the contribution of
//                             the side to popping. Distant primitives cover few pixels, so this weights by distance.
//                             small_part² + large_part² = popping², except for dust that no primitive reaches
//
// Units: display-encoded values; range 0..2. Threads: pure.
#pragma once

#include <optional>
#include <span>

#include "bench/measure/image/popping.h"
#include "bench/measure/image/screen_primitive.h"

namespace dustbench::bench {

struct SizedPrimitive {
    ScreenPrimitive place;
    double sizeMetres = 0;
    double opticalDepth = 0;  ///< through its centre
};

/// Optical depth of small and of large primitives at each pixel.
struct SizeDepths {
    Plane small, large;
};

/// Empty if all primitives have the same size within 1 %, or there are none.
[[nodiscard]] std::optional<SizeDepths> largeAmong(std::span<const SizedPrimitive> primitives, int width, int height);

/// Empty for a side that has no pixel with dust.
struct PoppingBySize {
    std::optional<double> small, large, smallPart, largePart;
};

/// Throws InputError if the sizes of the pictures differ.
[[nodiscard]] PoppingBySize poppingBySize(const DustFrame& before, const DustFrame& now, const SizeDepths& depthsBefore,
                                          const SizeDepths& depthsNow);

}  // namespace dustbench::bench
