// A suite's results as console tables: FPS and the stages of a frame, medians over the repetitions of each cell.
//
// Cells with the same world are adjacent, so that their methods can be compared.
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

/// FPS (median, minimum and maximum run), frame time, `own` (the method's own time, where the null method runs beside)
/// and stages. If the suite has one method in one setting, columns of
/// each row show what varies. Otherwise a row with only the world's label, `particles=500 speed=20`, heads the rows of
/// the methods, which are labelled with their varying settings: `octree_search layout=morton`. Rows with incomplete
/// runs are marked: `billboard (4 of 6 runs)`, and those with invalid runs: `billboard (2 of 6 invalid)`.
[[nodiscard]] TextRows tabulate(const Suite& suite, const StoredRuns& runs);

/// True if any run that is done was timed, or none is done.
[[nodiscard]] bool isTimed(const Suite& suite, const StoredRuns& runs);

/// The same rows for runs that are not timed: the chart's quantity, particles, primitives and bytes, medians over the
/// runs.
[[nodiscard]] TextRows tabulateCounts(const Suite& suite, const StoredRuns& runs);

/// The same rows with the metrics of judged runs (reports/METRICS.md); no rows if none were judged.
[[nodiscard]] TextRows tabulateMetrics(const Suite& suite, const StoredRuns& runs);

/// The runs of a cell that belongs to no suite.
struct MeasuredCell {
    std::string label;
    std::vector<const StoredRun*> done;
};
/// FPS, frame time and stages of such cells, each with its number of runs.
[[nodiscard]] TextRows tabulate(const std::vector<MeasuredCell>& cells);

/// Four significant digits, at most three after the point: `0.047`, `12.35`, `123.5`; empty for NaN.
[[nodiscard]] std::string fourDigits(double value);

}  // namespace dustbench::bench
