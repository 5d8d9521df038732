// The values of a rule's quantity in the rows of a summary: one for each cell (configuration) and each turn, which is a
// repetition or a seed.
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
    /// Of a ratio, growth or share; otherwise the value and 1.
    double numerator = 0, denominator = 1;
};

struct ClaimSamples {
    std::vector<Selection> cells;  ///< the columns that vary over the cells, with each cell's values
    std::vector<ClaimSample> list;
    std::vector<std::size_t> rows;  ///< the rows that were used, sorted
    std::size_t undefined = 0;      ///< number of pairs without a ratio because both values are 0
    std::size_t unmatched = 0;      ///< number of rows whose matched column the other side does not reach
    std::string missing;            ///< why there are no values
};

/// For every quantity except `exponent`, `finding` and `none`.
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
