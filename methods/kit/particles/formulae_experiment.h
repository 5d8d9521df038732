// Measures two formulae that the thesis prints with errors, as printed and as corrected (claims P9 and P12).
//
// Units: SI; colours are linear. Threads: one. Source: Thesis, 4.4.3 (Bézier curves), 5.1 (acceleration).
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::particles::formulae {

/// The experiment `formulae`:
///     bezier_end_printed, _mended    |P(1) − P_N| of curves through N + 1 = 4 random control values in 0..1, mean:
///                                    with the weights (N − t)^(N−i)·t^i as printed, and by de Casteljau's algorithm
///     bezier_end_printed_2           the same as printed for two control values, N = 1
///     bezier_six_by_sum, _printed    |difference| of the curve through six random control values by de Casteljau's
///                                    algorithm and by the sum of Bernstein polynomials, corrected and as printed, mean
///     bezier_equal_printed, _mended  value of a curve of four control values that are all 1, mean over t
///     acceleration_2kg_…             acceleration of a body of 2 kg under 1 N: by the printed m·ΣF, and by ΣF/m
///     momentum_2kg_…                 m·v over the force's impulse F·t after a second; 1 by Newton's second law
///     momentum_1kg_printed           the same for the thesis's mass of 1
///     casteljau_over_sum_6, _24      time of de Casteljau's algorithm over that of the sum of Bernstein polynomials,
///     for
///                                    6 and 24 control values; casteljau_over_casteljau_6: over its own, a control
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
/// The findings for this seed, each the mean of `draws` curves or bodies.
[[nodiscard]] std::vector<Finding> measureFormulae(std::uint64_t seed, std::int64_t draws);

/// The findings that are times.
[[nodiscard]] std::vector<Finding> measureCurveTimes(std::uint64_t seed);

}  // namespace dustbench::particles::formulae
