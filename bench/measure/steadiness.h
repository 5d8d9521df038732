// Whether a run's frame times are what a median stands for: signs of a warm-up that had not ended, of drift, of two
// speeds, and of stalls. They are said, never mended.
//
// With m the median and s = 1.4826·MAD (of normal noise, its standard deviation):
//   warm-up   the median of the first tenth of the frames is above that of the others by more than 5 % and by more than
//             4 standard errors, 1.2533·s/√n of each
//   drift     Theil and Sen's slope over the run, the first tenth left out, makes more than 5 % of m, and Kendall's
//   rank
//             test against the order of the frames gives |z| > 4
//   two speeds  the best split into two groups (minimum Σ of squares within) has means that differ by more than 10 %,
//             D = √2·|μ₁ − μ₂| / √(σ₁² + σ₂²) > 4.5 (an even spread has 3.5, a normal one 2.7), and at least a
//             tenth of the frames on either side
//   stalls    frames of more than 1.5·m that are also beyond m + 8·s
// All but stalls look at frames without them. Under 30 frames only stalls are looked for.
//
// Units: ms. Threads: pure. Source: Sen1968; Ashman1994. Departs: thresholds are ours.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace dustbench::bench {

/// A sentence for each sign, none for steady times.
[[nodiscard]] std::vector<std::string> steadinessWarnings(std::span<const double> frameMs);

}  // namespace dustbench::bench
