// Kendall's rank correlation: whether a cost rises or falls with a load, whatever the curve's shape.
//
//     τ = (C − D) / √((P − T_load)·(P − T_cost))
//
// over all P = n(n − 1)/2 pairs of points, of which C are concordant, D discordant, and T tied in the load or the cost.
// 1: rises from each load to the next; −1: falls. Threads: pure. Source: Kendall1938, with ties as τ_b.
#pragma once

#include <span>

#include "bench/measure/cost_fit.h"

namespace dustbench::bench {

/// In −1..1; 0 if either is the same in all points. NaN for fewer than two points.
[[nodiscard]] double rankCorrelation(std::span<const CostPoint> points);

}  // namespace dustbench::bench
