// Banding: the error that neighbouring pixels share.
//
// Too few samples along a ray leave bands in a smooth volume; jittered samples turn them into noise. A mean error does
// not distinguish the two. Averaged over a window, noise that is independent from pixel to pixel falls by the square
// root of the window's pixels, and a band wider than the window stays:
//
//     e(p)    = mean of I − R over the pixels of M within 5×5 around p     linear light, each channel
//     banding = √(Σ_M Σ_c e² / 3n)
//
// M is the mask (masked_error.h), n its number of pixels. In the frequency domain this is the error's power below about
// a tenth of a cycle per pixel: of a wave of 20 pixels 0.90 is left, of 10 pixels 0.65, of 5 nothing. Units: linear
// light. Threads: uses the current oneTBB arena; bit-identical at any number of threads.
#pragma once

#include <optional>

#include "bench/measure/image/masked_error.h"

namespace dustbench::bench {

inline constexpr int bandingWindow = 5;  ///< pixels along an edge

/// 0 or more; empty for an empty mask. Throws InputError if the sizes differ.
[[nodiscard]] std::optional<double> banding(const Picture& reference, const Picture& picture, const Mask& mask);

}  // namespace dustbench::bench
