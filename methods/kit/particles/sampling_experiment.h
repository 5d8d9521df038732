// Measures how uniform the thesis's random points and directions are, and those of our corrections (claims R18 to R20).
//
// Units: degrees in names. Threads: pure. Source: Thesis, 4.2.3 (rejection), 4.3.1 (directions), 4.3.2 and 4.3.3
// (cones).
#pragma once

#include <cstdint>
#include <vector>

#include "methods/contract/experiment.h"

namespace dustbench::particles::sampling {

/// The experiment `sampling`:
///     acceptance, tries_per_point    of points in a cube that are in its ball; Wilson's interval. With `_disc` and
///                                    `_4d` the same in two and four dimensions: π/4 and π²/32
///     corner_over_face_…             density of directions towards a cube's corners over that towards its faces, in
///                                    caps of 4 degrees: of normalised `cube` vectors, of normalised `gaussian` ones
///     chi2_per_cell_…                of the same directions and 96 cells of equal area, over its 95 degrees of freedom
///     cone30, cone90, nested20_30    maximum distance of the directions' distribution from the uniform one in a cone
///                                    of that half angle, or between two, as the thesis draws them; the interval of
///                                    Dvoretzky, Kiefer and Wolfowitz
///     …_by_cosine                    the same, drawn by interpolating the cosine
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
/// The findings for this seed, each from `draws` points or directions.
[[nodiscard]] std::vector<Finding> sampleDirections(std::uint64_t seed, std::int64_t draws);

}  // namespace dustbench::particles::sampling
