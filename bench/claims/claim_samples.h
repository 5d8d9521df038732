// The data of claims: the rows of completed runs in a summary.csv, and the values of a rule's quantity in them, one for
// each cell and each turn, which is a repetition or a seed.
//
// Rows that differ only in the repetition form a cell (configuration) of the experiment. Threads: pure.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim.h"
#include "bench/measure/cost_fit.h"
#include "methods/kit/files/csv.h"

namespace dustbench::claims {

/// A configuration: the values of the columns that distinguish rows, in the order of the table. Of a pair of rows, also
/// those of the second row.
struct Cell {
    std::vector<std::string> values, second{};
    auto operator<=>(const Cell&) const = default;
};

/// The rows of completed runs in a summary.csv.
class ResultRows {
 public:
    /// Uses the rows of `table` whose run is completed and valid and, if `runIds` is given, listed there.
    ResultRows(const files::CsvTable& table, const std::set<std::string>* runIds);

    /// Why rows that match the selection are not used: `clipped (3 runs)`; empty if none is invalid.
    [[nodiscard]] std::string invalidAmong(const Selection& selection) const;

    /// Rows that match the selection. Numbers are compared as numbers; a choice such as `speed=5|40` matches either.
    /// None if a column is missing in the table.
    [[nodiscard]] std::vector<std::size_t> select(const Selection& selection) const;

    [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column) const;
    [[nodiscard]] int repetition(std::size_t row) const;
    [[nodiscard]] const std::string& runId(std::size_t row) const;

    /// True if both rows have the same world, repetition and settings, except for the columns in `named` and those that
    /// are empty in one of them.
    [[nodiscard]] bool correspond(std::size_t a, std::size_t b, const std::set<std::string>& named) const;
    /// The cell of a row. The columns `except` are empty in it.
    [[nodiscard]] Cell cellOf(std::size_t row, const std::set<std::string>& except) const;
    /// The value of a column; for a pair of rows, that of the first. Empty if the column does not distinguish rows.
    [[nodiscard]] std::string valueIn(const Cell& cell, std::string_view column) const;
    /// The columns and values that distinguish a cell from the others: `p.particles` 500, `p.speed` 40. Columns in
    /// which the second row of a pair differs from the first appear with the prefix `with `.
    [[nodiscard]] Selection valuesThatDiffer(const Cell& cell, const std::vector<Cell>& cells) const;

 private:
    [[nodiscard]] bool matches(std::size_t row, const Selection& selection) const;

    const files::CsvTable& table_;
    std::vector<std::size_t> rows_, invalid_;
    std::vector<std::string> identity_;  ///< columns that distinguish cells
};

/// One value of a rule's quantity.
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
    std::vector<measure::CostPoint> points;
};
struct CostCurves {
    std::vector<CostCurve> curves;
    std::vector<std::size_t> rows;
    std::string missing;
};
[[nodiscard]] CostCurves costCurvesOf(const Rule& rule, const ResultRows& rows);

}  // namespace dustbench::claims
