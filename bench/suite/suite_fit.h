// The growth of costs with a load that a suite's `[[fit]]` tables ask for, from its stored runs.
//
// All cells that are equal but for the load make one curve, ms = a + b·N^k; each run is a point of it.
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

/// Points into the suite. Throws InputError where no cell has the parameter as a number.
[[nodiscard]] std::vector<LoadedCells> cellsByLoad(const Suite& suite, const PlannedFit& fit);

struct FittedCurve {
    std::string column, label;
    CostFit fit;
};

struct FitResult {
    std::string against;
    std::vector<FittedCurve> curves;
};

[[nodiscard]] std::vector<FitResult> fitSuite(const Suite& suite, const StoredRuns& runs);

/// A row for each curve: a, b and k with their intervals, loads and runs, or the reason why there is none.
[[nodiscard]] TextRows tabulate(const FitResult& result);

}  // namespace dustbench::bench
