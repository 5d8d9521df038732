// Checks whether the median represents a run's frame times: detects an unfinished warm-up, drift, two speeds, and
// stalls. They are reported, never corrected.
//
// With m the median and s = 1.4826·MAD (for normal noise, its standard deviation):
//   warm-up   the median of the first tenth of the frames exceeds that of the others by more than 5 % and by more than
//             4 standard errors, 1.2533·s/√n of each
//   drift     the Theil–Sen slope over the run, without the first tenth, amounts to more than 5 % of m, and Kendall's
//             rank test against the order of the frames gives |z| > 4
//   two speeds  the best split into two groups (minimum Σ of squares within) has means that differ by more than 10 %,
//             D = √2·|μ₁ − μ₂| / √(σ₁² + σ₂²) > 4.5 (a uniform distribution has 3.5, a normal one 2.7), and at least a
//             tenth of the frames on either side
//   stalls    frames above 1.5·m that are also above m + 8·s
// All tests except that for stalls exclude stalled frames. Below 30 frames only stalls are detected.
//
// Units: ms. Threads: pure. Source: Sen1968; Ashman1994. Departs: thresholds are ours.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace dustbench::measure {

/// One sentence per sign; empty for steady times.
[[nodiscard]] std::vector<std::string> steadinessWarnings(std::span<const double> frameMs);

}  // namespace dustbench::measure
