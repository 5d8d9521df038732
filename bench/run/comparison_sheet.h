// The contact sheet of judged runs: rows are moments; columns the exact picture, each method's, and where they differ.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/results/results_folder.h"
#include "bench/sheet/contact_sheet.h"

namespace dustbench::bench {

struct SheetRun {
    std::string runId;
    std::string label;  ///< heads its column
};

/// Reads what the runs left in `results`; all are of one world and the same moments. Throws InputError where a picture
/// is missing or cannot be read.
[[nodiscard]] ContactSheet comparisonSheet(const ResultsFolder& results, std::span<const SheetRun> runs,
                                           const std::string& title);

}  // namespace dustbench::bench
