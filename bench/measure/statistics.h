// Summary statistics of a run's frame times.
//
// All functions return NaN for no values.
#pragma once

#include <span>

namespace dustbench::bench {

/// The p-quantile (0 ≤ p ≤ 1), linear between order statistics: x₍ₖ₎ + f·(x₍ₖ₊₁₎ − x₍ₖ₎) with k + f = p·(n − 1), k from
/// 0. Source: Hyndman1996, definition 7.
[[nodiscard]] double quantile(std::span<const double> values, double p);

[[nodiscard]] double median(std::span<const double> values);

[[nodiscard]] double minimum(std::span<const double> values);
[[nodiscard]] double maximum(std::span<const double> values);

/// FPS = n·1000 / Σms: frames divided by the time they took, not the mean of their rates.
[[nodiscard]] double averageFps(std::span<const double> frameMs);

/// 1 % low, weighted by time: 1000 / t, where the frames of t ms and longer take 1 % of the total time. Counting from
/// the slowest frame, t is the frame at which the running sum reaches `share` of Σms. (Weighted by count, one long
/// stall among thousands of frames would not show.)
[[nodiscard]] double lowFps(std::span<const double> frameMs, double share = 0.01);

}  // namespace dustbench::bench
