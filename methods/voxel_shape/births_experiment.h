// Whether a shape of particles gives birth within the walls that it goes through (claim R12c).
//
// Looked at from outside, by the particles that the method hands over after each step: the newborn are those whose
// serials are new. Threads: the current oneTBB arena; the same at any number of
// them. Source: JuckelBeckhaus2007, 5.2.
#pragma once

#include <cstdint>

#include "methods/contract/experiment.h"

namespace dustbench::voxel_shape::births {

struct BirthReport {
    std::int64_t births = 0;
    std::int64_t inSolids = 0;  ///< that lie in a solid at the end of the step of their birth
};

/// The car of particles beside the vehicle of the scene `wall`, which drives at 20 m/s and meets a wall every 40 m, the
/// first one after 1 s. `solidsAreTold`: false keeps from the method that there are any.
[[nodiscard]] BirthReport driveThroughWalls(ExperimentContext& context, bool solidsAreTold, double seconds);

/// The experiment `births`, past two walls:
///     in_solids         particles born within solids
///     in_solids_untold  the same where the method does not know of the solids: what the experiment would find. Its
///                       `samples` are all births, as those of the first.
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::voxel_shape::births
