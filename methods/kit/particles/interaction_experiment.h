// Measures what forces between particles cost and how exact they are, by all pairs and by a tree (claim R23).
//
// Threads: one, so that times do not depend on their number. Source: Thesis, 5.4.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::particles::interaction {

/// The experiment `interaction`, of bodies in a uniform ball that attract each other by 1/d².
///
/// pairs_exponent, tree_exponent: of the time over the number of bodies, 1,000 to 16,000 and 4,000 to 64,000.
/// tree_work_exponent: of the pairs that the tree evaluates.
/// rms_angle_0.3 … rms_angle_1.2: root mean square error of the tree's force over that of the force, 20,000 bodies.
/// rms_ignored_0.6: the same where far bodies are ignored.
/// error_exponent: of that error over the angle.
/// rms_100k, speedup_100k: of 100,000 bodies at an angle of 0.65: the error, and the time of all pairs over the tree's,
/// its building included.
/// speedup_256: the same of 256 bodies.
/// crossover_bodies: the number from which on the tree at that angle is faster.
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
/// Its findings that are not times, for this seed.
[[nodiscard]] std::vector<Finding> measureErrors(std::uint64_t seed);

}  // namespace dustbench::particles::interaction
