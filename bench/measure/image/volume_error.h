// Errors of the volume that a method reports: its distance from the reference's volume, and from the method's own
// picture.
//
//     volume_error     ‖a − b‖ / ‖b‖                    over the cells of two equal grids of extinction
//     volume_picture   ‖α − α_V‖ / max(‖α‖, ‖α_V‖)      ‖·‖: root of the sum of squares over all pixels of the
//                                                       picture's alpha and the volume's (reported_depths.h)
//
// Sky adds 0 to each sum of volume_picture. If picture and volume disagree, metrics of the volume do not describe the
// picture.
// Units: none. Frame: cells with x fastest, then y (up). Threads: pure.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

struct GridCells {
    std::array<int, 3> cells{0, 0, 0};
    std::span<const float> extinctionPerMetre;
};

/// 0 or more: 0 for equal grids, 1 for an empty grid against the reference. Empty if the reference is empty. The map is
/// the view from above, one pixel per column of cells: √ Σ (a − b)² over the column, divided by ‖b‖, so that value² = Σ
/// map². Rows run along z, from its minimum.
/// Throws InputError for grids of different or wrong size, and for cells that are not finite.
[[nodiscard]] Measured volumeError(const GridCells& reference, const GridCells& grid);

/// Above this distance, the two have less than 3/4 of the larger one's sum of squares in common.
inline constexpr double maximumVolumePicture = 0.5;

/// 0 for equal planes, 1 if one is empty, √2 for disjoint ones of equal strength. Empty if both are 0 everywhere.
/// Throws InputError if the sizes differ.
[[nodiscard]] std::optional<double> volumePicture(const Plane& alpha, const Plane& volumeAlpha);

}  // namespace dustbench::measure
