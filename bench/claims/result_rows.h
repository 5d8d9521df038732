// The rows of a summary.csv that are done, as claims look at them.
//
// A cell of the experiment is all rows that are equal in everything but the repetition.
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
    /// The rows of `table` whose run is done and, where `runIds` are given, among them.
    ResultRows(const files::CsvTable& table, const std::set<std::string>* runIds);

    /// Those that have the selection's cells; numbers are compared as numbers. A column that the table has not: none.
    [[nodiscard]] std::vector<std::size_t> select(const Selection& selection) const;

    [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view column) const;
    [[nodiscard]] int repetition(std::size_t row) const;
    [[nodiscard]] const std::string& runId(std::size_t row) const;

    /// True where both were shown the same world in the same repetition with the same settings, but for the columns
    /// that `named` has, and those that one of them has not.
    [[nodiscard]] bool correspond(std::size_t a, std::size_t b, const std::set<std::string>& named) const;
    /// What a row's cell is known by, without the column `except`.
    [[nodiscard]] std::string cellKey(std::size_t row, std::string_view except) const;
    /// What tells a cell from the others, by their keys: `particles=500 speed=40`.
    [[nodiscard]] std::string cellText(const std::string& key, const std::vector<std::string>& keys) const;

 private:
    const files::CsvTable& table_;
    std::vector<std::size_t> rows_;
    std::vector<std::string> identity_;  ///< columns that tell cells apart
};

}  // namespace dustbench::bench
