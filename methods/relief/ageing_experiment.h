// How the cost of ageing a surface grows with the numbers of hits and texels, for both search modes (claim R25), and
// what a hit does to the paper's texture (claim R24).
//
// Threads: one. Source: Bergeron, 3.4, 4 and 5.
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"
#include "methods/relief/living_relief.h"

namespace dustbench::relief::ageing {

/// Returns the minimum of `repetitions` times to age a surface of side × side texels by `hits` random hits, in seconds.
[[nodiscard]] double ageingSeconds(Search search, int side, int hits, std::uint64_t seed, int repetitions);

/// Returns the slope of log(seconds) over log(size) by least squares.
[[nodiscard]] double growthExponent(const std::vector<double>& sizes, const std::vector<double>& seconds);

/// The experiment `ageing`:
///     gather_over_hits, gather_over_texels    exponents of the time of `gather`
///     scatter_over_hits, scatter_over_texels  the same of `scatter`
///     green_lowered                           share of steps in which y falls under the paper's motion
///     green_lowered_without_gravity           the same without gravity, a control
///     hit_texels_at_bottom                    share of the texels hit under the paper's ageing whose depth is 1
///     other_texels_changed                    share of the others whose depth is another than before
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::relief::ageing
