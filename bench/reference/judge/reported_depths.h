// The optical depth along every pixel's ray of a volume exactly as a method reported it.
//
// Puffs by the closed form (depth_sum.h), voxels and grid cells as cubes of constant extinction: the sum of extinction
// times the ray's length within each, from the eye to the opaque scene. No filter, no marching step.
//
// Units: metres; depth has none. Rows from the top. Threads: uses the current oneTBB arena; bit-identical at any number
// of threads.
#pragma once

#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/measure/image/picture.h"
#include "bench/reference/camera_rays.h"
#include "methods/contract/view.h"

namespace dustbench::reference {

/// Puffs together are too low by less than 1e-6 + 4e-9 of the sum; cubes are exact up to rounding. Throws
/// std::invalid_argument for distances that do not fit the view.
[[nodiscard]] std::vector<double> reportedDepths(const exports::CollectedVolume& volume, const scene::View& view,
                                                 const OpaqueDistances& distances);

/// 1 − exp(−depth) of each pixel.
[[nodiscard]] measure::Plane reportedAlpha(const exports::CollectedVolume& volume, const scene::View& view,
                                           const OpaqueDistances& distances);

}  // namespace dustbench::reference
