// Gaps: a trail that should be one and falls apart into puffs.
//
// The trail is where the reference has R > 0.1, and a method covers it where α ≥ R/2. The reference is `continuum`:
// that of the very same puffs would fall apart with them. Threads: pure.
#pragma once

#include <optional>

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

/// Reference alphas above it are the trail.
inline constexpr float trailAlpha = 0.1f;
/// A connected part of fewer pixels is a speck, not a part: where α and R/2 run close together, single pixels fall to
/// either side.
inline constexpr int minimumPartPixels = 16;

/// Share of the trail that is not covered: 0..1. Empty where the reference has no trail. The map is 1 in gaps, else 0.
/// Throws InputError for different sizes.
[[nodiscard]] Measured gaps(const Plane& alpha, const Plane& referenceAlpha);

struct TrailParts {
    /// Connected parts (by edges and corners) of what is covered: 0 or more, 0 where nothing is. Empty without a trail.
    std::optional<int> parts;
    /// The same of the reference itself, which all wheels or a hill in front may divide.
    std::optional<int> referenceParts;
    Plane map;  ///< 1, 2, …: the part that a pixel belongs to, in the order of their first pixels; 0: none
};

/// Throws InputError for different sizes.
[[nodiscard]] TrailParts components(const Plane& alpha, const Plane& referenceAlpha);

}  // namespace dustbench::bench
