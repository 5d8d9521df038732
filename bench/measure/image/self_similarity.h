// Self-similarity: visible repetition of one puff that the reference does not show.
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
//
// Units: none; frames in pixels. Threads: pure.
#pragma once

#include <cstdint>
#include <span>

#include "bench/measure/image/plane.h"
#include "bench/measure/image/screen_primitive.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
