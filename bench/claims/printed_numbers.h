// The numbers that a paper prints, beside ours: `data/papers/<id>/numbers.csv`.
//
// Its columns: `what` in words; `suite`, whose runs count (empty: all), and `of` them; `columns` of summary.csv whose
// sum is ours, with blanks between; `published`, as printed; `formula`, what the paper's formula gives when worked out,
// or empty.
#pragma once

#include <string>
#include <vector>

#include "bench/suite/suite_table.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {

/// A row for each of the paper's numbers: what, published, formula, measured (the median over the runs; empty where
/// there is none) and measured/formula. No rows where the paper has no such file. Throws InputError with file and line.
[[nodiscard]] TextRows tabulatePrinted(const std::string& paper, const files::CsvTable& summary);
/// The same of a table that was read already.
[[nodiscard]] TextRows tabulatePrinted(const files::CsvTable& published, const files::CsvTable& summary);

}  // namespace dustbench::bench
