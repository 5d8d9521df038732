// Which of two sessions took less time, judged from runs that were not measured by turns: the ratio of their times, its
// interval and a verdict.
//
// A drift of the machine hits the two sessions differently, so no run of one has a partner in the other. With the
// logarithms of n and m times, their means x̄ and ȳ and their standard deviations s and r, the 95 % interval of the
// ratio is
//
//     exp( x̄ − ȳ ± t(0.975; ν) · √(s²/n + r²/m) )        ν = (s²/n + r²/m)² / ( (s²/n)²/(n − 1) + (r²/m)²/(m − 1) )
//
// The interval holds what scattered within the sessions. What changed between them (heat, updates, neighbours) shows as
// a difference. Verdicts have the margin of paired_ratio.h, and need 6 times on either side.
//
// Units: times in any unit, the same for both. Threads: pure. Source: Welch1947, Satterthwaite1946.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "bench/measure/paired_ratio.h"

namespace dustbench::bench {

/// Times on either side below which nothing is resolved.
inline constexpr std::size_t minimumTimes = minimumPairs;

struct UnpairedRatio {
    std::size_t ofCount = 0, withCount = 0;
    double ratio = std::numeric_limits<double>::quiet_NaN();  ///< exp(x̄ − ȳ): of the geometric means
    double low = std::numeric_limits<double>::quiet_NaN();    ///< of the interval; NaN where a side has fewer than two
    double high = std::numeric_limits<double>::quiet_NaN();
    double degreesOfFreedom = std::numeric_limits<double>::quiet_NaN();  ///< ν
    Verdict verdict = Verdict::unresolved;

    [[nodiscard]] bool hasEnough() const { return ofCount >= minimumTimes && withCount >= minimumTimes; }
};

/// From the logarithms of the times.
[[nodiscard]] UnpairedRatio compareUnpairedLogs(std::span<const double> ofLogs, std::span<const double> withLogs);

}  // namespace dustbench::bench
