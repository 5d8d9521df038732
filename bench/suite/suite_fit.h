// Fits the growth of costs with a load, for a suite's `[[fit]]` tables, from its stored runs.
//
// All configurations that differ only in the load form one curve, ms = a + b·N^k; each valid run is a point of it.
#pragma once

#include <string>
#include <vector>

#include "bench/measure/cost_fit.h"
#include "bench/suite/cell_results.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_table.h"

namespace dustbench::bench {

struct LoadedCells {
    std::string label;  ///< `billboard speed=20`
    std::vector<const PlannedRun*> cells;
};

/// Points into the suite. Throws InputError if no configuration has a numeric value of the parameter.
[[nodiscard]] std::vector<LoadedCells> cellsByLoad(const Suite& suite, const PlannedFit& fit);

struct FittedCurve {
    std::string column, label;
    CostFit fit;              ///< from valid runs
    std::size_t invalid = 0;  ///< number of invalid runs, which are left out
};

struct FitResult {
    std::string against;
    std::vector<FittedCurve> curves;
};

[[nodiscard]] std::vector<FitResult> fitSuite(const Suite& suite, const StoredRuns& runs);

/// A row for each curve: a, b and k with their intervals, loads and runs; without a fit, the reason.
[[nodiscard]] TextRows tabulate(const FitResult& result);

}  // namespace dustbench::bench
