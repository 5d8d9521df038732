// Gaps and spill: where a method lacks a trail that should be continuous, and where it shows one that should not exist.
//
// The trail is where the reference has R > 0.1; a method covers it where α ≥ R/2. The method's own trail is where
// α > 0.1; it spills where α > 2R. Exchanging the two pictures exchanges the metrics: gaps are errors of omission,
// spill errors of commission. A faulty picture can be perfect in one of them: dust everywhere has no gaps, an empty
// picture no spill. The reference must be `continuum`: one made from the same puffs would break up with them.
// Threads: pure. Source: Congalton1991 (omission and commission).
#pragma once

#include <optional>

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

/// Alphas above this are the trail.
inline constexpr float trailAlpha = 0.1f;
/// Connected regions with fewer pixels are specks and do not count: where α and R/2 are almost equal, single pixels may
/// be on either side.
inline constexpr int minimumPartPixels = 16;

/// Share of the trail that is not covered: 0..1. Empty if the reference has no trail. The map is 1 in gaps, else 0.
/// Throws InputError if the sizes differ.
[[nodiscard]] Measured gaps(const Plane& alpha, const Plane& referenceAlpha);

/// Share of the method's own trail (α > 0.1) where α > 2R: 0..1. Empty if the method shows no trail. The map is 1 where
/// it spills, else 0. Throws InputError if the sizes differ.
[[nodiscard]] Measured spill(const Plane& alpha, const Plane& referenceAlpha);

struct TrailParts {
    /// Connected components (by edges and corners) of the covered area: 0 or more. Empty if there is no trail.
    std::optional<int> parts;
    /// The same for the reference itself, which separate wheels or a hill in front may divide.
    std::optional<int> referenceParts;
    Plane map;  ///< the number (1, 2, …) of the part that a pixel belongs to, in order of their first pixels; 0: none
};

/// Throws InputError if the sizes differ.
[[nodiscard]] TrailParts components(const Plane& alpha, const Plane& referenceAlpha);

}  // namespace dustbench::bench
