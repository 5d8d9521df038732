// The growth of a cost with a load, from runs at several loads: a fit of ms = a + b·N^k with confidence intervals, and
// the rank correlation, which assumes no shape of the curve.
//
// The fit: least squares of the relative residuals (ms_i − a − b·N_i^k) / ms_i, since the scatter of times is
// proportional to the times; a is kept at 0 or above. For a given exponent the fit is linear in a and b, so k is found
// by a one-dimensional search. With the Jacobian J at the solution, n runs and p parameters,
//
//     s² = Σ residual² / (n − p),    interval of parameter i: ± t(0.975; n − p) · √(s² (JᵀJ)⁻¹_ii)
//
// If the best fit has a = 0, a is not counted as a parameter (p = 2) and has no interval.
//
// The correlation: Kendall's
//
//     τ = (C − D) / √((P − T_load)·(P − T_cost))
//
// over all P = n(n − 1)/2 pairs of points, of which C are concordant, D discordant, and T tied in the load or the cost.
// 1: rises from each load to the next; −1: falls.
//
// Units: times in ms, loads in any unit. Threads: pure. Source: Bates1988, chapter 2; Kendall1938, with ties as τ_b.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace dustbench::measure {

struct CostPoint {
    double load;  ///< N
    double ms;
};

/// A value and the half-width of its 95 % interval; NaN if undefined.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double plusMinus = std::numeric_limits<double>::quiet_NaN();
};

struct CostFit {
    Estimate fixedMs;   ///< a
    Estimate factor;    ///< b, in ms per N^k
    Estimate exponent;  ///< k
    std::size_t loads = 0;
    std::size_t runs = 0;
    double relativeError = std::numeric_limits<double>::quiet_NaN();  ///< s
    /// Why there is no fit, as a clause without a full stop; empty if there is one.
    std::string reason{};
};

/// Range of the exponent search. A result at either end is rejected.
inline constexpr double minimumExponent = 0.05;
inline constexpr double maximumExponent = 4;

/// Accepts any points. Fewer than 4 distinct loads above 0, times that are not positive numbers, or costs that do not
/// grow with the load give a reason instead of a fit.
[[nodiscard]] CostFit fitCost(std::span<const CostPoint> points);

/// τ, whether the cost rises or falls with the load: in −1..1; 0 if either is the same in all points. NaN for fewer
/// than two points.
[[nodiscard]] double rankCorrelation(std::span<const CostPoint> points);

}  // namespace dustbench::measure
