// Flaws of a method's picture that its reference does not have (hard edges, gaps and spill of a trail, repetition), and
// how many primitives were drawn for it.
//
// Units: none; alpha per pixel; primitives per pixel. Threads: pure.
// Source: Congalton1991 (omission and commission).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bench/measure/image/picture.h"

namespace dustbench::measure {

// --- Cut-off: hard edges where dust meets the ground or a solid, and not in the reference.
//
//     cutoff = RMS of |∇[(α − α_free) − (R − R_free)]|      _free: drawn without the scene's depth
//
// over the pixels with dust (α_free or R_free > 0.01), so that empty parts of the picture do not lower the value. ∇ is
// the difference to the pixel on the right and to the one below: a hard edge is one pixel wide, and central differences
// would halve it. The last column and the last row, which lack these neighbours, are excluded.

/// Range 0..2√2. Empty if no dust is in view. The map is |∇[…]| where there is dust, else 0. Throws InputError if the
/// sizes differ.
[[nodiscard]] Measured cutoff(const Plane& alpha, const Plane& alphaFree, const Plane& referenceAlpha,
                              const Plane& referenceAlphaFree);

// --- Gaps and spill: where a method lacks a trail that should be continuous, and where it shows one that should not
// exist.
//
// The trail is where the reference has R > 0.1; a method covers it where α ≥ R/2. The method's own trail is where
// α > 0.1; it spills where α > 2R. Exchanging the two pictures exchanges the metrics: gaps are errors of omission,
// spill errors of commission. A faulty picture can be perfect in one of them: dust everywhere has no gaps, an empty
// picture no spill. The reference must be `continuum`: one made from the same puffs would break up with them.

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

// --- Self-similarity: visible repetition of one puff that the reference does not show.
//
// The detail is α − R. Alpha excludes the scene behind the dust, which all puffs share.
// Around each primitive the detail is sampled at 17×17 points within ±0.8 r of the centre, and the mean is subtracted.
// With p_i these 289 numbers, normalised to length 1, the value is the mean over all pairs of
//
//     p_i · p_j       (normalised cross-correlation)
//
// minus the same for centres shifted by N(0, r) along x and y. Similarity of neighbours due to overlap is in both
// terms; similarity of the primitives themselves is in the first only. Detail with an RMS below half a step of an 8-bit
// picture is invisible: its p is 0, so it resembles nothing.

/// Smaller primitives show no detail to compare.
inline constexpr double minimumRadiusPixels = 4;
inline constexpr std::size_t minimumPrimitives = 8;
/// If there are more, a random sample of this size is used; it depends only on the seed.
inline constexpr std::size_t maximumPrimitives = 2048;

/// −1..1: about 0 if no two are alike, 1 if all are and nothing hides them. Empty for fewer than 8 primitives with a
/// radius of at least 4 pixels and ±0.8 r wholly inside the picture. The map is |α − R|: 0..1. Throws InputError if the
/// sizes differ.
[[nodiscard]] Measured selfSimilarity(const Plane& alpha, const Plane& referenceAlpha,
                                      std::span<const ScreenPrimitive> primitives, std::uint64_t seed);

// --- Primitives drawn per pixel of dust: the cost of the picture

/// Primitives divided by the number of pixels with R > 0.01: 0 or more. Empty if there are no such pixels. Counts all
/// primitives handed to the GPU, including those out of view.
[[nodiscard]] std::optional<double> quadsPerPixel(std::int64_t primitives, const Plane& referenceAlpha);

/// The map: the number of quads (half side 1.5 r) that cover each pixel's centre.
[[nodiscard]] Plane overdrawMap(std::span<const ScreenPrimitive> primitives, int width, int height);

}  // namespace dustbench::measure
