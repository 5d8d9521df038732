// Adds runs of the null method to a suite: the baseline of its methods' own times.
#pragma once

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// The suite with one configuration of the null method, at its defaults and without pictures, appended to `cells` for
/// each world in which another method runs. It repeats as often as the world's most repeated configuration. Unchanged
/// if Suite::baseline is false, if a world already has such a configuration, or if this build has no null method.
[[nodiscard]] Suite withBaselines(Suite suite);

}  // namespace dustbench::bench
