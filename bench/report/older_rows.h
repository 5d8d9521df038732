// Gives the rows of an older build's summary.csv the ids of this build.
//
// A new parameter changes the id of every run of its method (reports/SCHEMA.md, Names). If the suite has the parameter
// at its default, the run is still the same. Only for tables: runs in a folder keep their ids.
#pragma once

#include <string>
#include <vector>

#include "bench/results/stored_run.h"

namespace dustbench::report {

/// Renames runs that belong to no suite but match exactly one run of a suite in all their fields. Parameters that they
/// lack must be at their defaults there. Adds a sentence to `problems` with the number of runs and the new parameters.
void adoptOlderRows(results::StoredRuns& runs, std::vector<std::string>& problems);

}  // namespace dustbench::report
