// The contact sheet of several runs. Rows are moments; columns are the reference image, each method's picture, and its
// difference. With many methods and few moments, the methods are the rows instead.
//
// A method with its own simulation has no reference image: only its picture is shown.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/report/contact_sheet.h"
#include "bench/results/results_folder.h"

namespace dustbench::report {

struct SheetRun {
    std::string runId;
    std::string label;      ///< heading of its pictures
    bool evaluated = true;  ///< it has metrics against the reference images
};

/// Reads the pictures of the runs in `results`. All runs must have the same world and moments, and at least one must
/// have metrics. Throws InputError if a picture is missing or cannot be read.
[[nodiscard]] ContactSheet sideBySideSheet(const results::ResultsFolder& results, std::span<const SheetRun> runs,
                                           const std::string& title);

/// Returns the file, `folder`/contact_sheet.svg.
std::filesystem::path writeContactSheet(const ContactSheet& sheet, const std::filesystem::path& folder);
/// `folder`/contact_sheet.png from the .svg. Throws InputError if rsvg-convert is not installed or fails.
std::filesystem::path drawContactSheet(const std::filesystem::path& folder);

}  // namespace dustbench::report
