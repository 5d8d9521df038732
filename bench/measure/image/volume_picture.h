// Whether a method draws the volume that it reports: the distance of its picture's alpha from that of the volume's own.
//
//     ‖α − α_V‖ / max(‖α‖, ‖α_V‖)      ‖·‖: root of the sum of squares over all pixels; α_V: see reported_depths.h
//
// Sky adds 0 to each sum. What is computed from the volume (`volume_error`) says nothing about the picture if the two
// disagree.
// Units: none. Threads: pure.
#pragma once

#include <optional>

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

/// A distance of half of the picture: above it, less than 3/4 of the larger one's sum of squares is in common.
inline constexpr double maximumVolumePicture = 0.5;

/// 0 for equal planes, 1 if one is empty, √2 for disjoint ones of equal strength. Empty if both are 0 everywhere.
/// Throws InputError if the sizes differ.
[[nodiscard]] std::optional<double> volumePicture(const Plane& alpha, const Plane& volumeAlpha);

}  // namespace dustbench::bench
