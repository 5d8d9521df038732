// Computes the verdicts of a suite's `[[compare]]` tables from its stored runs.
//
// Two cells are paired if scene, drive, size and the world's parameters are equal, and so are the methods' own
// parameters that the suite varies on both sides. Parameters named by a side (`octree_search layout=morton`) are
// exempt. Repetition k of one is paired with repetition k of the other; both ran in the same round, so a suite in
// batches resolves nothing. Runs from different machines, possible in merged folders, are not paired, nor
// are invalid runs; the reason counts them.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/paired_ratio.h"
#include "bench/suite/cell_results.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_table.h"

namespace dustbench::bench {

struct CellPair {
    const PlannedRun* of = nullptr;
    const PlannedRun* with = nullptr;
    std::vector<std::string> at;  ///< a value for each axis
};

struct MatchedCells {
    std::vector<std::string> axes;  ///< what differs between the pairs
    std::vector<CellPair> pairs;
};

/// Points into the suite. Throws InputError if no two cells can be compared.
[[nodiscard]] MatchedCells matchCells(const Suite& suite, const PlannedComparison& comparison);

struct CellVerdict {
    std::vector<std::string> at;  ///< a value for each axis; all empty for all cells together
    PairedRatio result;
    std::string reason;  ///< why there is not enough data for a verdict, or what was left out; else empty
};

/// One column of summary.csv. For all cells together, each round gives one ratio, the geometric mean over the pairs of
/// cells; a round counts if all pairs of cells that were measured at all have times in it.
struct ColumnVerdict {
    std::string column;
    std::vector<CellVerdict> cells;
    CellVerdict overall;
};

struct ComparisonResult {
    std::string of, with;
    std::vector<std::string> axes;
    std::vector<ColumnVerdict> columns;
};

[[nodiscard]] std::vector<ComparisonResult> suiteVerdicts(const Suite& suite, const StoredRuns& runs);

/// A row for each column and pair of cells: ratio, interval, pairs and verdict; then `build_ms_median, all`.
[[nodiscard]] TextRows tabulate(const ComparisonResult& comparison);

/// One line per column for all cells: `build_ms_median: A takes 0.84 [0.81, 0.87] of the time of B: FASTER`.
[[nodiscard]] std::vector<std::string> conclusions(const ComparisonResult& comparison);

}  // namespace dustbench::bench
