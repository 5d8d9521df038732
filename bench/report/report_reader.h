// Reads a results folder for its report, tolerating missing and damaged files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// Default limit of embedded pictures, in bytes.
inline constexpr std::int64_t defaultPictureBytes = 12'000'000;

/// The papers that the report judges: those of the groups. A paper whose groups all are suites that another one lists
/// as controls is left out.
[[nodiscard]] std::set<std::string> papersOf(const std::vector<RunGroup>& groups);
/// Reads everything that the page shows, with a sentence for each thing that cannot be read. Throws InputError if
/// `folder` is not a folder.
[[nodiscard]] ReportData readReport(const std::filesystem::path& folder, std::int64_t maximumPictureBytes);

}  // namespace dustbench::bench
