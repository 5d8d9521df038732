// The errors of a picture where there is dust. A whole picture is mostly sky, which every method draws correctly.
//
// The mask is the pixels with α > 1/255 in the method's layer or in the reference's; n is their number, M the mask.
//
//     psnr_mask_db     = −10 log₁₀ (Σ_M Σ_c (I − R)² / 3n)    display-encoded
//     rmse_linear_mask = √(Σ_M Σ_c (I − R)² / 3n)             linear light
//     error_max        = max_M max_c |I − R|                  linear light
//     ssim_mask        = mean of the SSIM map (picture_error.h) over the windows whose centre is in M. Only windows
//                        inside the picture count, so pixels of M within 5 pixels of the picture's edge have none. A
//                        window can extend beyond M by 5 pixels.
//     flip_mask        = mean of FLIP's map (picture_error.h) over M
//
// Sky added around a picture changes none of them if the distance between mask and picture edge exceeds the reach of
// the filters: 5 pixels for SSIM, 0.14 degrees for FLIP.
// Units: decibels; linear light. Threads: banding uses the current oneTBB arena, bit-identical at any number of
// threads; the others are pure.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

/// One step of an 8-bit picture over black.
inline constexpr float maskAlpha = 1.0f / 255;

/// 1 or 0 per pixel.
using Mask = PlaneOf<std::uint8_t>;

/// The pixels with alpha above `maskAlpha` in either plane. Throws InputError if the sizes differ.
[[nodiscard]] Mask dustMask(const Plane& alpha, const Plane& referenceAlpha);

/// All empty for an empty mask.
struct MaskedError {
    std::optional<double> psnrDb;      ///< empty also if no encoded value differs within the mask
    std::optional<double> rmseLinear;  ///< 0 or more
    std::optional<double> maximum;     ///< 0 or more
};
/// Throws InputError if the sizes differ.
[[nodiscard]] MaskedError maskedError(const Picture& reference, const Picture& picture, const Mask& mask);

/// Mean of a metric's map over the mask. A map smaller than the mask, such as that of SSIM, is centred in it. Empty if
/// no pixel of the mask has a value.
[[nodiscard]] std::optional<double> meanWithin(const Plane& map, const Mask& mask);

// --- Banding: the error that neighbouring pixels share.
//
// Too few samples along a ray leave bands in a smooth volume; jittered samples turn them into noise. A mean error does
// not distinguish the two. Averaged over a window, noise that is independent from pixel to pixel falls by the square
// root of the window's pixels, and a band wider than the window stays:
//
//     e(p)    = mean of I − R over the pixels of M within 5×5 around p     linear light, each channel
//     banding = √(Σ_M Σ_c e² / 3n)
//
// In the frequency domain this is the error's power below about
// a tenth of a cycle per pixel: of a wave of 20 pixels 0.90 is left, of 10 pixels 0.65, of 5 nothing.

inline constexpr int bandingWindow = 5;  ///< pixels along an edge

/// 0 or more; empty for an empty mask. Throws InputError if the sizes differ.
[[nodiscard]] std::optional<double> banding(const Picture& reference, const Picture& picture, const Mask& mask);

}  // namespace dustbench::measure
