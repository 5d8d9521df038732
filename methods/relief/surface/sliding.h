// Deposits on a surface slide down where they are steeper than their angle of repose.
//
// The slope at texel i is that to its lower neighbours, the upwind gradient: g = (max(hᵢ − h₋, hᵢ − h₊, 0)/Δ) along
// each axis. Where |g| > tan φ, the texel gives material to the lower neighbour along each axis, in proportion to the
// slopes, until |g| falls just below tan φ. Texels wait in a queue and are checked again when a neighbour changes. A
// texel gives at most half of a difference in height, so that the sum of the squared heights decreases with each move
// and sliding ends.
//
// The surface itself does not slide, and nothing slides over the rim, so the volume is preserved exactly. The order of
// the queue is fixed, so the result depends on the depths alone.
//
// Units: m, depths in steps of DepthMap; φ against the panel's face. Threads: one.
// Source: Sumner1999, 3.3 (erosion by a slope threshold, to lower neighbours). Departs: whole steps, a queue instead of
// passes, and the slope as a gradient, so that piles are round.
#pragma once

#include <cstdint>
#include <span>

#include "methods/relief/surface/depth_map.h"

namespace dustbench::relief {

struct Repose {
    double tangent = 0.7;  ///< tan φ, above 0
    glm::dvec2 texelMetres{1};
    double depthMetres = 1;

    /// Slope of one step of depth between neighbours.
    [[nodiscard]] glm::dvec2 slopePerStep() const { return depthMetres / DepthMap::bottom / texelMetres; }
};

/// The slope to the lower neighbours along both axes, as a tangent.
[[nodiscard]] glm::dvec2 slopeDown(const DepthMap& map, int column, int row, const Repose& repose);

/// Lets deposits on the texels of `moved`, and on those next to it, slide until they rest. Returns the changed texels,
/// including `moved`.
[[nodiscard]] TexelRectangle slide(DepthMap& map, std::span<std::uint32_t> laid, const TexelRectangle& moved,
                                   const Repose& repose);

}  // namespace dustbench::relief
