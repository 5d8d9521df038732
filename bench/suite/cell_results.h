// The stored runs of a suite's configurations (cells), and the numbers in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/results/stored_run.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

/// The run of this repetition (from 1) if it is done, else null.
[[nodiscard]] const StoredRun* doneRun(const PlannedRun& cell, int repetition, const StoredRuns& runs);
/// All runs of a configuration that are done, in order.
[[nodiscard]] std::vector<const StoredRun*> doneRuns(const PlannedRun& cell, int repetitions, const StoredRuns& runs);

/// The same without invalid runs, as fits and verdicts use them.
[[nodiscard]] const StoredRun* validRun(const PlannedRun& cell, int repetition, const StoredRuns& runs);
[[nodiscard]] std::vector<const StoredRun*> validOf(std::vector<const StoredRun*> done);

/// A value of summary.csv; empty if the run has none.
[[nodiscard]] std::optional<double> numberIn(const StoredRun& run, std::string_view column);
/// The values of all runs that have one.
[[nodiscard]] std::vector<double> numbersIn(const std::vector<const StoredRun*>& runs, std::string_view column);

}  // namespace dustbench::bench
