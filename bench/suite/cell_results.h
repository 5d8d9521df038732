// The stored runs of a suite's cells, and the numbers in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

/// The cell's run of this repetition (from 1) where it is done, or null.
[[nodiscard]] const StoredRun* doneRun(const PlannedRun& cell, int repetition, const StoredRuns& runs);
/// All that are done, in order.
[[nodiscard]] std::vector<const StoredRun*> doneRuns(const PlannedRun& cell, int repetitions, const StoredRuns& runs);

/// A cell of summary.csv; nothing where it is empty.
[[nodiscard]] std::optional<double> numberIn(const StoredRun& run, std::string_view column);
/// Those of the runs that have it.
[[nodiscard]] std::vector<double> numbersIn(const std::vector<const StoredRun*>& runs, std::string_view column);

}  // namespace dustbench::bench
