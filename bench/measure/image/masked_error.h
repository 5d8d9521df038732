// The errors of a picture where there is dust. A whole picture is mostly sky, which every method draws correctly.
//
// The mask is the pixels with α > 1/255 in the method's layer or in the reference's; n is their number, M the mask.
//
//     psnr_mask_db     = −10 log₁₀ (Σ_M Σ_c (I − R)² / 3n)    display-encoded
//     rmse_linear_mask = √(Σ_M Σ_c (I − R)² / 3n)             linear light
//     error_max        = max_M max_c |I − R|                  linear light
//     ssim_mask        = mean of the SSIM map (ssim.h) over the windows whose centre is in M. Only windows inside the
//                        picture count, so pixels of M within 5 pixels of the picture's edge have none. A window can
//                        extend beyond M by 5 pixels.
//     flip_mask        = mean of FLIP's map (flip.h) over M
//
// Sky added around a picture changes none of them if the distance between mask and picture edge exceeds the reach of
// the filters: 5 pixels for SSIM, 0.14 degrees for FLIP.
// Units: decibels; linear light. Threads: pure.
#pragma once

#include <cstdint>
#include <optional>

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
