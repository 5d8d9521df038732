// Compares the times of two alternatives from paired runs: their ratio, its interval and a verdict.
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
//
// Units: times in any unit, the same for both. Threads: pure. Source: Student1908.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace dustbench::bench {

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

/// The p-quantile (0 < p < 1) of Student's t distribution.
[[nodiscard]] double studentQuantile(double p, double degreesOfFreedom);

}  // namespace dustbench::bench
