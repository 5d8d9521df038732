// Adds the runs of the null method that a suite's times are measured from.
#pragma once

#include "bench/suite/suite.h"

namespace dustbench::bench {

/// The suite with the null method, at its defaults and without pictures, appended to `cells` once for each world in
/// which another method runs. It repeats as often as the world's most repeated cell. Unchanged where
/// Suite::baseline is false, where a world has such a cell already, or if this build has no null method.
[[nodiscard]] Suite withBaselines(Suite suite);

}  // namespace dustbench::bench
