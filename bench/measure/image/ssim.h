// Structural similarity: agreement of two pictures in brightness, contrast and structure, per window.
//
//     SSIM = (2 μr μi + C₁)(2 σri + C₂) / ((μr² + μi² + C₁)(σr² + σi² + C₂))     C₁ = 0.01², C₂ = 0.03²
//
// Means, variances and covariance are weighted by a Gaussian window of 11×11 pixels, σ = 1.5, that sums to 1 (so the
// variances are population variances), on Rec. 709 luma of the display-encoded values. Only windows wholly inside the
// picture count.
// Units: none. Threads: uses the current oneTBB arena; the same at any number of threads. Source: Wang2004, Eq. 13.
#pragma once

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

inline constexpr int ssimWindow = 11;

/// Mean of the map: −1..1, 1 for identical pictures. Empty for pictures smaller than one window. The map is 10 pixels
/// smaller than the pictures in width and height; its first pixel corresponds to the picture's (5, 5). Throws
/// InputError if the sizes differ.
[[nodiscard]] Measured ssim(const Picture& reference, const Picture& picture);

}  // namespace dustbench::bench
