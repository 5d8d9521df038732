// Differences between two whole pictures: error per pixel (PSNR and RMSE), structural similarity (SSIM), and the
// difference that a viewer perceives (FLIP).
//
// Units: decibels; linear light; pixels per degree of the field of view. Threads: use the current oneTBB arena; the
// same at any number of threads. Source: Wang2004, Eq. 13; Andersson2020, sections 4 and 5.
#pragma once

#include <optional>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

// --- Per-pixel error between two pictures: PSNR of display-encoded values, RMSE of linear light.
//
//     psnr_db = −10 log₁₀ MSE       MSE over the three display-encoded channels of all pixels, whose peak is 1
//     rmse_linear = √ mean (I − R)²  over the three linear channels of all pixels

struct PictureError {
    std::optional<double> psnrDb;  ///< 0 or more; empty for identical pictures, where MSE is 0
    bool identical = false;        ///< no display-encoded value differs
    double rmseLinear = 0;         ///< 0 or more. Above 0 for `identical` pictures only if they differ outside [0, 1]
    Plane encodedRms;              ///< √ mean over the channels of the squared encoded difference: 0..1
    Plane linearRms;               ///< the same for linear light: 0 or more
};

/// Throws InputError if the sizes differ.
[[nodiscard]] PictureError pictureError(const Picture& reference, const Picture& picture);

// --- Structural similarity: agreement of two pictures in brightness, contrast and structure, per window.
//
//     SSIM = (2 μr μi + C₁)(2 σri + C₂) / ((μr² + μi² + C₁)(σr² + σi² + C₂))     C₁ = 0.01², C₂ = 0.03²
//
// Means, variances and covariance are weighted by a Gaussian window of 11×11 pixels, σ = 1.5, that sums to 1 (so the
// variances are population variances), on Rec. 709 luma of the display-encoded values. Only windows wholly inside the
// picture count.

inline constexpr int ssimWindow = 11;

/// Mean of the map: −1..1, 1 for identical pictures. Empty for pictures smaller than one window. The map is 10 pixels
/// smaller than the pictures in width and height; its first pixel corresponds to the picture's (5, 5). Throws
/// InputError if the sizes differ.
[[nodiscard]] Measured ssim(const Picture& reference, const Picture& picture);

// --- FLIP: the difference that a viewer perceives when flipping between two pictures, per pixel.
//
// The pictures are filtered by the eye's contrast sensitivity at the given viewing distance; the remaining colour
// difference is ΔE_c in [0, 1]. Edges and points that occur in only one picture give ΔE_f in [0, 1], which raises it:
//
//     ΔE = ΔE_c ^ (1 − ΔE_f)
//
// This is the variant for low-dynamic-range displays: linear light is first clamped to [0, 1].

/// A display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double defaultPixelsPerDegree = 67.02;
inline constexpr double minimumPixelsPerDegree = 1, maximumPixelsPerDegree = 1000;

/// Mean of the map: 0..1, 0 for identical pictures. The map has the size of the pictures, values 0..1. Throws
/// InputError if the sizes differ or the pixels per degree are out of range.
[[nodiscard]] Measured flip(const Picture& reference, const Picture& picture,
                            double pixelsPerDegree = defaultPixelsPerDegree);

}  // namespace dustbench::measure
