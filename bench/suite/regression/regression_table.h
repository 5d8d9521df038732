// A comparison of two results folders as a table for people and as comparison.csv. `reports/SCHEMA.md` has the columns.
#pragma once

#include <optional>
#include <string>

#include "bench/suite/regression/folder_comparison.h"
#include "bench/suite/suite_table.h"

namespace dustbench::bench {

[[nodiscard]] TextRows tabulate(const FolderComparison& comparison);

/// The columns of comparison.csv before and after those that tell the cells.
[[nodiscard]] std::vector<std::string> comparisonColumnsBefore();
[[nodiscard]] std::vector<std::string> comparisonColumnsAfter();

/// All that was compared, then the cells that are done in one folder alone. `percent`: what counts as a regression;
/// none: nothing was asked for.
[[nodiscard]] std::string comparisonCsv(const FolderComparison& comparison, std::optional<double> percent);

}  // namespace dustbench::bench
