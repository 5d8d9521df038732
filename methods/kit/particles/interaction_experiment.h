// Measures cost and accuracy of forces between particles, by all pairs and by a tree (claim R23).
//
// Threads: one, so that times do not depend on the number of threads. Source: Thesis, 5.4.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::particles::interaction {

/// The experiment `interaction`: bodies in a uniform ball that attract each other by 1/d², or by 1/d³ if the name
/// contains `cube`.
///
/// pairs_exponent, tree_exponent: exponents of the time by the number of bodies, 1,000 to 16,000 and 4,000 to
/// 64,000.
/// tree_work_exponent: exponent of the number of pairs that the tree evaluates.
/// rms_angle_0.3 … rms_angle_1.2: root mean square error of the tree's force relative to the force, 20,000 bodies.
/// rms_ignored_0.6: the same with distant bodies ignored; ignored_over_together_0.6: its ratio to rms_angle_0.6.
/// together_over_together_0.6: the ratio of rms_angle_0.6 to itself, a control.
/// rms_cube_angle_0.6, rms_cube_ignored_0.1 … _0.6: both for a force that falls like 1/d³.
/// error_exponent: exponent of that error by the angle.
/// rms_100k, speedup_100k: for 100,000 bodies at an angle of 0.65, the error, and the time of all pairs over that of
/// the tree, including its construction.
/// speedup_256: the same for 256 bodies.
/// crossover_bodies: the number of bodies above which the tree at that angle is faster.
[[nodiscard]] DUSTBENCH_API ExperimentInfo describe();
/// Returns the findings that are not times, for this seed.
[[nodiscard]] std::vector<Finding> measureErrors(std::uint64_t seed);

}  // namespace dustbench::particles::interaction
