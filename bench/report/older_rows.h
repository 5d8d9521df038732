// Rows of an older build's summary.csv, under the ids that this build gives their runs.
//
// A parameter that was added since changes the id of every run of its method (reports/SCHEMA.md, Names). Where the
// suite has the parameter at its default, the run is the same one. For tables alone: runs in a folder keep their ids.
#pragma once

#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Renames runs that no suite has and that are one cell of a suite in all that they say; what they do not say must be
/// at its default there. A sentence in `problems` tells how many, and which parameters are new.
void adoptOlderRows(StoredRuns& runs, std::vector<std::string>& problems);

}  // namespace dustbench::bench
