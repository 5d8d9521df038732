// A suite's results as console tables: FPS and stages, medians over the repetitions of each configuration.
//
// Configurations in the same world are adjacent, so that their methods can be compared.
// Units: ms, and frames per second.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite.h"
#include "bench/suite/suite_cells.h"

namespace dustbench::suite {

struct TextRows {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

/// FPS (median, minimum and maximum run), frame time, `own` (the method's own time, if the null method ran too) and
/// stages. If the suite has one method with one setting, columns show what varies. Otherwise a row with only the
/// world's label, `particles=500 speed=20`, precedes the rows of the methods, which are labelled with their varying
/// settings: `octree_search layout=morton`. Incomplete rows are marked, `billboard (4 of 6 runs)`, and so are rows with
/// invalid runs, `billboard (2 of 6 invalid)`.
[[nodiscard]] TextRows tabulate(const Suite& suite, const results::StoredRuns& runs);

/// True if a run that is done was timed, or if no run is done.
[[nodiscard]] bool isTimed(const Suite& suite, const results::StoredRuns& runs);

/// The same rows for runs without times: the chart's quantity, particles, primitives and bytes, as medians over the
/// runs.
[[nodiscard]] TextRows tabulateCounts(const Suite& suite, const results::StoredRuns& runs);

/// The same rows with metrics (reports/METRICS.md); no rows if no run has metrics.
[[nodiscard]] TextRows tabulateMetrics(const Suite& suite, const results::StoredRuns& runs);

/// The runs of a configuration that does not belong to a suite.
struct MeasuredCell {
    std::string label;
    std::vector<const results::StoredRun*> done;
};
/// FPS, frame time and stages of such configurations, each with its number of runs.
[[nodiscard]] TextRows tabulate(const std::vector<MeasuredCell>& cells);

/// Four significant digits, at most three decimals: `0.047`, `12.35`, `123.5`; empty for NaN.
[[nodiscard]] std::string fourDigits(double value);

}  // namespace dustbench::suite
