// Distance of the opaque scene along each pixel's ray, where integration of the dust ends.
//
// Units: metres, Euclidean from the eye along the ray (not along the camera's axis). Rows from the top.
// Threads: pure.
#pragma once

#include <span>
#include <vector>

#include "methods/contract/view.h"

namespace dustbench::bench {

struct OpaqueDistances {
    int width = 0;
    int height = 0;
    std::vector<double> metres;  ///< width·height; +inf for sky
};

/// From a reversed depth image, rows from the top: depth = near / distance along the axis, 0 is the sky. With the
/// slopes x, y of the pixel's ray, the distance is near/depth·√(1 + x² + y²). Exact for the given depth;
/// single-precision reversed depth itself is accurate to 6e-8 of the distance. Throws std::invalid_argument if the
/// number of values is not view.width·view.height, and for depths outside [0, 1] or NaN.
[[nodiscard]] OpaqueDistances distancesFromDepth(const scene::View& view, std::span<const float> depth);

/// No opaque scene: all sky.
[[nodiscard]] OpaqueDistances skyDistances(const scene::View& view);

/// Throws std::invalid_argument unless `distances` fits the view and every distance is 0 or more (+inf included).
void checkDistances(const scene::View& view, const OpaqueDistances& distances);

}  // namespace dustbench::bench
