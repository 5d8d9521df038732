// The ratio of two means whose denominator may be near 0, such as a difference of two times.
//
// For pairs (x_i, y_i), the ratio is ρ = x̄/ȳ. The interval contains every ρ for which Student's test does not
// distinguish the mean of x − ρ·y from 0. With variances v_xx, v_yy and covariance v_xy of the means, t the quantile
// for n − 1 degrees of freedom and g = t² v_yy/ȳ²:
//
//     ( ρ − g v_xy/v_yy  ±  t/ȳ · √( v_xx − 2ρ v_xy + ρ² v_yy − g (v_xx − v_xy²/v_yy) ) ) / (1 − g)
//
// For g ≥ 1 the denominator cannot be distinguished from 0, and any ratio is possible. Single pairs may have any sign:
// leaving out those with y ≤ 0 would shift the ratio.
//
// Units: any, the same for x and y gives a pure number. Threads: pure. Source: Fieller1954.
#pragma once

#include <limits>
#include <span>
#include <utility>

namespace dustbench::bench {

struct RatioOfMeans {
    double ratio = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unbounded, or fewer than two pairs
    double high = std::numeric_limits<double>::quiet_NaN();
};

/// `level`: confidence level of the interval, above 0 and below 1.
[[nodiscard]] RatioOfMeans ratioOfMeans(std::span<const std::pair<double, double>> pairs, double level);

}  // namespace dustbench::bench
