// Formats a comparison of two results folders as a console table and as comparison.csv. `reports/SCHEMA.md` defines the
// columns.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "bench/suite/regression/folder_comparison.h"
#include "bench/suite/suite_table.h"

namespace dustbench::suite {

[[nodiscard]] TextRows tabulate(const FolderComparison& comparison);

/// The columns of comparison.csv before and after those that identify the configuration.
[[nodiscard]] std::vector<std::string> comparisonColumnsBefore();
[[nodiscard]] std::vector<std::string> comparisonColumnsAfter();

/// All comparisons, then the configurations that are done in only one folder. `percent`: the regression threshold;
/// empty: none.
[[nodiscard]] std::string comparisonCsv(const FolderComparison& comparison, std::optional<double> percent);

/// The same in Markdown for a merge request: a sentence in bold, a table of the regressions (`isRegression`), and all
/// rows in a collapsed section.
[[nodiscard]] std::string comparisonMarkdown(const FolderComparison& comparison, std::string_view a, std::string_view b,
                                             const std::function<bool(const EvaluatedCell&)>& isRegression);

}  // namespace dustbench::suite
