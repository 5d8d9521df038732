// Finds the first intersection of a segment with a relief, exactly: no speed is too high.
//
// Along a straight line d(t) = d₀ + t·Δd within one bilinear patch, d(t) − D(u(t), v(t)) is a quadratic in t. The
// patches are visited in the order of the line; the first root in a patch is the hit.
//
// Units and frame: depth_map.h; the third component is the depth. Threads: pure.
// Source: Bergeron, 3.3 (a hit is where z ≥ Depth(x, y)). Departs: the paper tests the end of a step only.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "methods/relief/surface/depth_map.h"

namespace dustbench::relief {

/// Returns the share 0..1 of the segment from `from` to `to` at which d ≥ D first holds; 0 if it holds at `from`. Both
/// ends must be finite. The map extends beyond its rim as far as the segment.
[[nodiscard]] std::optional<double> firstHit(const DepthMap& map, const glm::dvec3& from, const glm::dvec3& to);

}  // namespace dustbench::relief
