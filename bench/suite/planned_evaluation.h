// The `[[compare]]` and `[[fit]]` tables of a suite: comparisons of one method's times with another's, and fits of
// times against a load.
#pragma once

#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::suite {

/// The configurations of one method, optionally only those with given parameters: `octree_search layout=morton`.
struct ComparedSide {
    std::string method;
    results::ParameterTexts pinned;  ///< in canonical form
    std::string label;
};

struct PlannedComparison {
    ComparedSide of, with;
    std::vector<std::string> columns;  ///< columns of summary.csv
    std::string where;                 ///< `file:line: `, for messages
};

/// The `[[compare]]` tables; none if the key is missing or an empty array. `methods` are those of the suite. Throws
/// InputError with file and line.
[[nodiscard]] std::vector<PlannedComparison> readComparisons(files::TomlReader& suite,
                                                             const std::vector<std::string>& methods);

struct PlannedFit {
    std::vector<std::string> columns;  ///< columns of summary.csv
    std::string against;               ///< the parameter that is the load
    std::string where;                 ///< `file:line: `, for messages
};

/// The `[[fit]]` tables; none if the key is missing or an empty array. Throws InputError with file and line.
[[nodiscard]] std::vector<PlannedFit> readFits(files::TomlReader& suite);

/// The columns of summary.csv that can be compared: times, and rates as the time per frame.
[[nodiscard]] std::vector<std::string> comparableColumns();
/// The columns of summary.csv that hold numbers to draw.
[[nodiscard]] std::vector<std::string> chartColumns();
/// Whether the column is a rate, which is the inverse of a time.
[[nodiscard]] bool isRate(std::string_view column);

}  // namespace dustbench::suite
