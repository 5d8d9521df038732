// Compares the numbers printed in a paper with ours: `data/papers/<id>/numbers.csv`.
//
// Its columns: `what`, a description; `suite`, whose runs are used (empty: all), and `of`, a selection of them;
// `columns` of summary.csv, separated by spaces, whose sum is our number; `published`, the printed number; `formula`,
// the value of the paper's formula, or empty.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite_table.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

/// A row for each of the paper's numbers: what, published, formula, measured (the median over the runs; empty if there
/// are none) and measured/formula. No rows if the paper has no such file. Throws InputError with file and line.
[[nodiscard]] TextRows tabulatePrinted(const std::string& paper, const files::CsvTable& summary);
/// The same for a table that was already read.
[[nodiscard]] TextRows tabulatePrinted(const files::CsvTable& published, const files::CsvTable& summary);

}  // namespace dustbench::bench
