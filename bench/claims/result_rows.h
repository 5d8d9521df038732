// The rows of done runs in a summary.csv, as used by claims.
//
// A cell of the experiment is all rows that are equal in everything except the repetition.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bench/claims/claim.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

class ResultRows {
 public:
    /// Uses the rows of `table` whose run is done and, if `runIds` is given, listed there.
    ResultRows(const files::CsvTable& table, const std::set<std::string>* runIds);

    /// Rows that match the selection; numbers are compared as numbers. None if the table lacks a column.
    [[nodiscard]] std::vector<std::size_t> select(const Selection& selection) const;

    [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column) const;
    [[nodiscard]] int repetition(std::size_t row) const;
    [[nodiscard]] const std::string& runId(std::size_t row) const;

    /// True if both rows have the same world, repetition and settings, ignoring the columns in `named` and those that
    /// one of them lacks.
    [[nodiscard]] bool correspond(std::size_t a, std::size_t b, const std::set<std::string>& named) const;
    /// Identifies the cell of a row, without the column `except`.
    [[nodiscard]] std::string cellKey(std::size_t row, std::string_view except) const;
    /// The values that distinguish a cell from the others with these keys: `particles=500 speed=40`.
    [[nodiscard]] std::string cellText(const std::string& key, const std::vector<std::string>& keys) const;

 private:
    const files::CsvTable& table_;
    std::vector<std::size_t> rows_;
    std::vector<std::string> identity_;  ///< columns that distinguish cells
};

}  // namespace dustbench::bench
