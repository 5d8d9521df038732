// machine.csv: the machine, driver and build of a folder's runs, for a folder of tables alone (summary_runs.h).
#pragma once

#include <string>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// A header and one row, of the run that started first among those that are done. Throws InputError without one.
[[nodiscard]] std::string machineCsv(const StoredRuns& runs);

}  // namespace dustbench::bench
