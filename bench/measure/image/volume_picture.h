// Checks whether a method draws the volume that it reports: the distance between the alpha of its picture and that of
// the reported volume.
//
//     ‖α − α_V‖ / max(‖α‖, ‖α_V‖)      ‖·‖: root of the sum of squares over all pixels; α_V: see reported_depths.h
//
// Sky adds 0 to each sum. If the two disagree, metrics of the volume (`volume_error`) do not describe the picture.
// Units: none. Threads: pure.
#pragma once

#include <optional>

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

/// Above this distance, the two have less than 3/4 of the larger one's sum of squares in common.
inline constexpr double maximumVolumePicture = 0.5;

/// 0 for equal planes, 1 if one is empty, √2 for disjoint ones of equal strength. Empty if both are 0 everywhere.
/// Throws InputError if the sizes differ.
[[nodiscard]] std::optional<double> volumePicture(const Plane& alpha, const Plane& volumeAlpha);

}  // namespace dustbench::bench
