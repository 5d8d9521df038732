// Statistics of times: summaries of a run's frames, and ratios of two alternatives with intervals and verdicts.
//
// Times may be in any unit, the same for all that are compared; frame rates take milliseconds. All summaries are NaN
// for no values.
//
// Threads: pure. Source: Hyndman1996, Student1908, Welch1947, Satterthwaite1946, Fieller1954.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

namespace dustbench::measure {

/// The p-quantile (0 ≤ p ≤ 1), linear between order statistics: x₍ₖ₎ + f·(x₍ₖ₊₁₎ − x₍ₖ₎) with k + f = p·(n − 1), k from
/// 0 (definition 7 of Hyndman1996).
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

/// The p-quantile (0 < p < 1) of Student's t distribution.
[[nodiscard]] double studentQuantile(double p, double degreesOfFreedom);

// --- Paired runs of two alternatives: the ratio of their times, its interval and a verdict.
//
// The i-th times of both were measured in the same round, so drift of the machine affects both and cancels in their
// ratio. With x_i = ln(of_i / with_i), mean x̄ and standard deviation s over n pairs, the 95 % interval of the ratio is
//
//     exp( x̄ ± t(0.975; n − 1) · s / √n )
//
// The margin δ = 2 % reaches from 1/(1 + δ) to 1 + δ, which is ± ln(1 + δ) for x: the verdicts are symmetric under
// exchange of the two.
//     FASTER       the interval lies wholly below 1/(1 + δ): `of` takes less time
//     SLOWER       wholly above 1 + δ
//     SAME         wholly within the margin, its ends included
//     UNRESOLVED   anything else, and always for fewer than 6 pairs
// Two alternatives of equal speed give FASTER in at most 1 of 20 comparisons, however noisy they are, and in fewer than
// 1 of 40 if the single ratios scatter by 5 % or less.

inline constexpr double sameMargin = 0.02;
inline constexpr double intervalConfidence = 0.95;
inline constexpr std::size_t minimumPairs = 6;

enum class Verdict { faster, slower, same, unresolved };
/// `FASTER` …
[[nodiscard]] std::string_view verdictName(Verdict verdict);

struct PairedRatio {
    std::size_t pairs = 0;
    double ratio = std::numeric_limits<double>::quiet_NaN();  ///< exp(x̄): the geometric mean of the pairs' ratios
    double low = std::numeric_limits<double>::quiet_NaN();    ///< of the interval; NaN for fewer than two pairs
    double high = std::numeric_limits<double>::quiet_NaN();
    Verdict verdict = Verdict::unresolved;
};

/// Compares times pair by pair. Throws InputError if the counts differ, or a time is not a positive number.
[[nodiscard]] PairedRatio comparePaired(std::span<const double> of, std::span<const double> with);

/// The same, given ln(of / with) of each pair.
[[nodiscard]] PairedRatio evaluateLogRatios(std::span<const double> logRatios);

/// Verdict from the logarithms of an interval's ends and the margin, as above. Does not check the number of pairs.
[[nodiscard]] Verdict evaluateInterval(double lowLog, double highLog);

// --- Two sessions whose runs were not interleaved: the ratio of their times, its interval and a verdict.
//
// Drift of the machine affects the two sessions differently, so their runs cannot be paired. With the logarithms of n
// and m times, their means x̄ and ȳ and their standard deviations s and r, the 95 % interval of the ratio is
//
//     exp( x̄ − ȳ ± t(0.975; ν) · √(s²/n + r²/m) )        ν = (s²/n + r²/m)² / ( (s²/n)²/(n − 1) + (r²/m)²/(m − 1) )
//
// The interval covers the scatter within the sessions. Changes between them (heat, updates, other load) appear as a
// difference. Verdicts use the margin above and need 6 times on either side.

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

// --- The ratio of two means whose denominator may be near 0, such as a difference of two times.
//
// For pairs (x_i, y_i), the ratio is ρ = x̄/ȳ. The interval contains every ρ for which Student's test does not
// distinguish the mean of x − ρ·y from 0. With variances v_xx, v_yy and covariance v_xy of the means, t the quantile
// for n − 1 degrees of freedom and g = t² v_yy/ȳ²:
//
//     ( ρ − g v_xy/v_yy  ±  t/ȳ · √( v_xx − 2ρ v_xy + ρ² v_yy − g (v_xx − v_xy²/v_yy) ) ) / (1 − g)
//
// For g ≥ 1 the denominator cannot be distinguished from 0, and any ratio is possible. Single pairs may have any sign:
// leaving out those with y ≤ 0 would shift the ratio (Fieller1954).

struct RatioOfMeans {
    double ratio = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unbounded, or fewer than two pairs
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// `level`: confidence level of the interval, above 0 and below 1.
[[nodiscard]] RatioOfMeans ratioOfMeans(std::span<const std::pair<double, double>> pairs, double level);

}  // namespace dustbench::measure
