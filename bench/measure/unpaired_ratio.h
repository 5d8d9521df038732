// Compares the times of two sessions whose runs were not interleaved: the ratio of their times, its interval and a
// verdict.
//
// Drift of the machine affects the two sessions differently, so their runs cannot be paired. With the logarithms of n
// and m times, their means x̄ and ȳ and their standard deviations s and r, the 95 % interval of the ratio is
//
//     exp( x̄ − ȳ ± t(0.975; ν) · √(s²/n + r²/m) )        ν = (s²/n + r²/m)² / ( (s²/n)²/(n − 1) + (r²/m)²/(m − 1) )
//
// The interval covers the scatter within the sessions. Changes between them (heat, updates, other load) appear as a
// difference. Verdicts use the margin of paired_ratio.h and need 6 times on either side.
//
// Units: times in any unit, the same for both. Threads: pure. Source: Welch1947, Satterthwaite1946.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "bench/measure/paired_ratio.h"

namespace dustbench::bench {

/// With fewer times on either side the verdict is UNRESOLVED.
inline constexpr std::size_t minimumTimes = minimumPairs;

struct UnpairedRatio {
    std::size_t ofCount = 0, withCount = 0;
    double ratio = std::numeric_limits<double>::quiet_NaN();  ///< exp(x̄ − ȳ): of the geometric means
    double low = std::numeric_limits<double>::quiet_NaN();    ///< of the interval; NaN if a side has fewer than two
                                                              ///< times
    double high = std::numeric_limits<double>::quiet_NaN();
    double degreesOfFreedom = std::numeric_limits<double>::quiet_NaN();  ///< ν
    Verdict verdict = Verdict::unresolved;

    [[nodiscard]] bool hasEnough() const { return ofCount >= minimumTimes && withCount >= minimumTimes; }
};

/// Takes the logarithms of the times.
[[nodiscard]] UnpairedRatio compareUnpairedLogs(std::span<const double> ofLogs, std::span<const double> withLogs);

}  // namespace dustbench::bench
