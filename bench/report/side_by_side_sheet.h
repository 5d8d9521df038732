// The contact sheet of runs: rows are moments; columns the exact picture, each method's, and where they differ from it.
//
// A method with a simulation of its own has no exact picture: it is shown as it is.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/report/sheet/contact_sheet.h"
#include "bench/results/results_folder.h"

namespace dustbench::bench {

struct SheetRun {
    std::string runId;
    std::string label;   ///< heads its column
    bool judged = true;  ///< against the exact pictures
};

/// Reads what the runs left in `results`; all are of one world and the same moments, and one of them at least is
/// judged. Throws InputError where a picture is missing or cannot be read.
[[nodiscard]] ContactSheet sideBySideSheet(const ResultsFolder& results, std::span<const SheetRun> runs,
                                           const std::string& title);

}  // namespace dustbench::bench
