// The stored runs of a suite's cells, and the numbers in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

/// The cell's run of this repetition (from 1) if it is done, else null.
[[nodiscard]] const StoredRun* doneRun(const PlannedRun& cell, int repetition, const StoredRuns& runs);
/// All done runs of a cell, in order.
[[nodiscard]] std::vector<const StoredRun*> doneRuns(const PlannedRun& cell, int repetitions, const StoredRuns& runs);

/// The same of valid runs alone: what fits and verdicts use.
[[nodiscard]] const StoredRun* validRun(const PlannedRun& cell, int repetition, const StoredRuns& runs);
[[nodiscard]] std::vector<const StoredRun*> validOf(std::vector<const StoredRun*> done);

/// A cell of summary.csv; empty if it has no value.
[[nodiscard]] std::optional<double> numberIn(const StoredRun& run, std::string_view column);
/// The values of the runs that have one.
[[nodiscard]] std::vector<double> numbersIn(const std::vector<const StoredRun*>& runs, std::string_view column);

}  // namespace dustbench::bench
