// A suite's results for people: FPS and the stages of a frame, medians over the repetitions of each cell.
//
// Cells that show their methods the same world stand together, so that the methods can be read against each other.
// Units: ms, and frames per second.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/cell_results.h"
#include "bench/suite/suite.h"

namespace dustbench::bench {

struct TextRows {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

/// FPS (median, minimum and maximum run), frame time and stages. Where the suite has one method in one setting, a row
/// says in columns of its own what varies; otherwise a row `particles=500 speed=20`, empty but for that, heads the
/// rows of the methods, and these say which settings vary: `octree_search layout=morton`. Rows whose runs are not
/// all done tell so: `billboard (4 of 6 runs)`.
[[nodiscard]] TextRows tabulate(const Suite& suite, const StoredRuns& runs);

/// The same rows with the metrics of those that were judged (reports/METRICS.md); no rows where none were.
[[nodiscard]] TextRows tabulateMetrics(const Suite& suite, const StoredRuns& runs);

/// Four digits, three of them behind the point at most: `0.047`, `12.35`, `123.5`; empty for NaN.
[[nodiscard]] std::string fourDigits(double value);

}  // namespace dustbench::bench
