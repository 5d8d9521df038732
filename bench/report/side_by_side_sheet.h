// The contact sheet of runs: rows are moments; columns are the exact picture, each method's picture, and its
// difference. With many methods and few moments the methods are the rows instead.
//
// A method with its own simulation has no exact picture: only its picture is shown.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/report/contact_sheet.h"
#include "bench/results/results_folder.h"

namespace dustbench::bench {

struct SheetRun {
    std::string runId;
    std::string label;   ///< heading of its pictures
    bool judged = true;  ///< against the exact pictures
};

/// Reads the pictures of the runs in `results`. All runs are of one world and the same moments, and at least one is
/// judged. Throws InputError if a picture is missing or cannot be read.
[[nodiscard]] ContactSheet sideBySideSheet(const ResultsFolder& results, std::span<const SheetRun> runs,
                                           const std::string& title);

/// Returns the file, `folder`/contact_sheet.svg.
std::filesystem::path writeContactSheet(const ContactSheet& sheet, const std::filesystem::path& folder);
/// `folder`/contact_sheet.png from the .svg. Throws InputError if rsvg-convert is not installed or fails.
std::filesystem::path drawContactSheet(const std::filesystem::path& folder);

}  // namespace dustbench::bench
