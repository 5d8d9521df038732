// Evaluates a suite's `[[compare]]` and `[[fit]]` tables (planned_evaluation.h) from its stored runs.
//
// For a comparison, two configurations are paired if scene, drive, size, the world's parameters and the method
// parameters that the suite varies on both sides are equal. Parameters named by a side (`octree_search layout=morton`)
// are exempt. Repetition k of one is paired with repetition k of the other, because both ran in the same round; a suite
// in batches therefore gives no verdicts. Runs from different machines, possible in merged folders, are not paired, nor
// are invalid runs; the reason counts them.
//
// For a fit of costs against a load, all configurations that differ only in the load form one curve, ms = a + b·N^k;
// each valid run is a point of it.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/cost_fit.h"
#include "bench/measure/statistics.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_table.h"

namespace dustbench::suite {

struct CellPair {
    const PlannedRun* of = nullptr;
    const PlannedRun* with = nullptr;
    std::vector<std::string> at;  ///< a value for each axis
};

struct MatchedCells {
    std::vector<std::string> axes;  ///< what differs between the pairs
    std::vector<CellPair> pairs;
};

/// Points into the suite. Throws InputError if no two configurations can be compared.
[[nodiscard]] MatchedCells matchCells(const Suite& suite, const PlannedComparison& comparison);

struct CellVerdict {
    std::vector<std::string> at;  ///< a value for each axis; all empty for all configurations together
    measure::PairedRatio result;
    std::string reason;  ///< why there are not enough data for a verdict, or what was left out; else empty
};

/// One column of summary.csv. For all configurations together, each round gives one ratio, the geometric mean over the
/// pairs; a round counts if all pairs that were measured in any round have times in it.
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

[[nodiscard]] std::vector<ComparisonResult> suiteVerdicts(const Suite& suite, const results::StoredRuns& runs);

/// A row for each column and pair of configurations: ratio, interval, pairs and verdict; then `build_ms_median, all`.
[[nodiscard]] TextRows tabulate(const ComparisonResult& comparison);

/// One line per column for all configurations: `build_ms_median: A takes 0.84 [0.81, 0.87] of the time of B: FASTER`.
[[nodiscard]] std::vector<std::string> conclusions(const ComparisonResult& comparison);

/// A curve of costs over a load: configurations that differ only in the load.
struct LoadedCells {
    std::string label;  ///< `billboard speed=20`
    std::vector<const PlannedRun*> cells;
};

/// Points into the suite. Throws InputError if no configuration has a numeric value of the parameter.
[[nodiscard]] std::vector<LoadedCells> cellsByLoad(const Suite& suite, const PlannedFit& fit);

struct FittedCurve {
    std::string column, label;
    measure::CostFit fit;     ///< from valid runs
    std::size_t invalid = 0;  ///< number of invalid runs, which are left out
};

struct FitResult {
    std::string against;
    std::vector<FittedCurve> curves;
};

[[nodiscard]] std::vector<FitResult> fitSuite(const Suite& suite, const results::StoredRuns& runs);

/// A row for each curve: a, b and k with their intervals, loads and runs; without a fit, the reason.
[[nodiscard]] TextRows tabulate(const FitResult& result);

}  // namespace dustbench::suite
