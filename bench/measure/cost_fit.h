// How a cost grows with a load: ms = a + b·N^k, fitted to runs with several loads, with its uncertainty.
//
// Least squares of the relative residuals (ms_i − a − b·N_i^k) / ms_i, since times scatter in proportion to themselves;
// a is kept at 0 or above. For a given exponent the fit is linear in a and b, so k is searched on a line. With the
// Jacobian J at the solution, n runs and p parameters,
//
//     s² = Σ residual² / (n − p),    interval of parameter i: ± t(0.975; n − p) · √(s² (JᵀJ)⁻¹_ii)
//
// Where the best fit has a = 0, a is no parameter (p = 2) and has no interval.
// Units: times in ms, loads in any unit. Threads: pure. Source: Bates1988, chapter 2.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace dustbench::bench {

struct CostPoint {
    double load;  ///< N
    double ms;
};

/// A number and half the width of its 95 % interval; NaN where there is none.
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
    /// Why there is no fit, as a sentence without its end; empty where there is one.
    std::string reason{};
};

/// Exponents that are looked for; one at either end counts as none.
inline constexpr double minimumExponent = 0.05;
inline constexpr double maximumExponent = 4;

/// Of any points: fewer than 4 different loads above 0, times that are no numbers above 0 and costs that do not grow
/// with the load give a reason in place of a fit.
[[nodiscard]] CostFit fitCost(std::span<const CostPoint> points);

}  // namespace dustbench::bench
