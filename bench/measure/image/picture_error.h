// Per-pixel error between two pictures: PSNR of display-encoded values, RMSE of linear light.
//
//     psnr_db = −10 log₁₀ MSE       MSE over the three display-encoded channels of all pixels, whose peak is 1
//     rmse_linear = √ mean (I − R)²  over the three linear channels of all pixels
//
// Units: decibels; linear light. Threads: pure.
#pragma once

#include <optional>

#include "bench/measure/image/picture.h"

namespace dustbench::bench {

struct PictureError {
    std::optional<double> psnrDb;  ///< 0 or more; empty for identical pictures, where MSE is 0
    bool identical = false;        ///< no display-encoded value differs
    double rmseLinear = 0;         ///< 0 or more. Above 0 for `identical` pictures only if they differ outside [0, 1]
    Plane encodedRms;              ///< √ mean over the channels of the squared encoded difference: 0..1
    Plane linearRms;               ///< the same for linear light: 0 or more
};

/// Throws InputError if the sizes differ.
[[nodiscard]] PictureError pictureError(const Picture& reference, const Picture& picture);

}  // namespace dustbench::bench
