// The values of a rule's quantity in the rows of a summary, before they are judged: one for each cell of the experiment
// and each turn, that is each repetition or seed.
//
// Threads: pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/claims/claim.h"
#include "bench/claims/result_rows.h"
#include "bench/measure/cost_fit.h"

namespace dustbench::bench {

struct ClaimSample {
    std::size_t cell = 0;   ///< index in `cells`
    std::int64_t turn = 1;  ///< repetition or seed
    double value = 0;       ///< NaN: a ratio whose denominator is not above 0
    /// Of a ratio, growth or share; else the value and 1.
    double numerator = 0, denominator = 1;
};

struct ClaimSamples {
    std::vector<Selection> cells;  ///< the columns that vary over the cells, with each cell's values
    std::vector<ClaimSample> list;
    std::vector<std::size_t> rows;  ///< that were used, sorted
    std::size_t undefined = 0;      ///< pairs without a ratio, since both columns are 0
    std::size_t unmatched = 0;      ///< rows whose matched column the other side does not reach
    std::string missing;            ///< why there are no values
};

/// For every quantity but `exponent`, `finding` and `none`.
[[nodiscard]] ClaimSamples samplesOf(const Rule& rule, const ResultRows& rows);

/// The points that an exponent is fitted to.
struct CostCurve {
    Selection cell;
    std::vector<CostPoint> points;
};
struct CostCurves {
    std::vector<CostCurve> curves;
    std::vector<std::size_t> rows;
    std::string missing;
};
[[nodiscard]] CostCurves costCurvesOf(const Rule& rule, const ResultRows& rows);

}  // namespace dustbench::bench
