// Self-similarity: the same puff again and again, which the eye finds where the reference has none of it.
//
// The detail is α − R: alpha, because what the scene shows through the dust is the same behind all puffs and none of
// their doing. Around each primitive it is sampled at 17×17 points within ±0.8 r of its centre, and the mean is taken
// off. With p_i these 289 numbers, scaled to length 1, the number is the mean over all pairs of
//
//     p_i · p_j       (normalised cross-correlation)
//
// minus the same around centres that are shifted by N(0, r) along x and y. What neighbours share because they overlap
// is in both; what belongs to the primitive is in the first alone. Detail of an RMS below half a step of an 8-bit
// picture cannot be seen: its p is 0, so it resembles nothing.
//
// Units: none; frames in pixels. Threads: pure.
#pragma once

#include <cstdint>
#include <span>

#include "bench/measure/image/plane.h"
#include "bench/measure/image/screen_primitive.h"

namespace dustbench::bench {

/// Smaller ones show no detail to compare.
inline constexpr double minimumRadiusPixels = 4;
inline constexpr std::size_t minimumPrimitives = 8;
/// Of more, as many are drawn by lot: of a seed, the same ones each time.
inline constexpr std::size_t maximumPrimitives = 2048;

/// −1..1, about 0 where no two look alike, 1 where all do and nothing hides them. Empty for fewer than 8 primitives of
/// at least 4 pixels' radius whose ±0.8 r lie wholly within the picture. The map is |α − R|: 0..1.
/// Throws InputError for different sizes.
[[nodiscard]] Measured selfSimilarity(const Plane& alpha, const Plane& referenceAlpha,
                                      std::span<const ScreenPrimitive> primitives, std::uint64_t seed);

}  // namespace dustbench::bench
