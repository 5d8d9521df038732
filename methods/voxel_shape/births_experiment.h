// Tests whether a shape of particles emits particles inside the walls that it passes through (claim R12c).
//
// Uses only the particles that the method exposes after each step; newborn ones have new serials. Threads:
// uses the current oneTBB arena; the result does not depend on the number of threads. Source: JuckelBeckhaus2007, 5.2.
#pragma once

#include <cstdint>

#include "methods/contract/experiment.h"

namespace dustbench::voxel_shape::births {

struct BirthReport {
    std::int64_t births = 0;
    std::int64_t inSolids = 0;  ///< in a solid at the end of the step of their birth
};

/// Drives the particle car with the vehicle of the scene `wall`, which drives at 20 m/s and meets a wall every 40 m,
/// the first after 1 s. `solidsAreKnown` = false hides the solids from the method.
[[nodiscard]] BirthReport driveThroughWalls(ExperimentContext& context, bool solidsAreKnown, double seconds);

/// The experiment `births`, past two walls:
///     in_solids         particles born inside solids
///     in_solids_untold  the control: the same with the solids hidden from the method
/// `samples` of each finding is the total number of births.
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::voxel_shape::births
