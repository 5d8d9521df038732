// Reads a results folder for its report, tolerating missing and damaged files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// Default limit of embedded pictures, in bytes.
inline constexpr std::int64_t defaultPictureBytes = 12'000'000;

/// The papers whose claims the report evaluates: those of the groups. A paper is left out if all of its groups are
/// suites that another paper lists as controls.
[[nodiscard]] std::set<std::string> papersOf(const std::vector<RunGroup>& groups);
/// Reads the data of the page, with a sentence for everything that cannot be read. Throws InputError if `folder` is not
/// a folder.
[[nodiscard]] ReportData readReport(const std::filesystem::path& folder, std::int64_t maximumPictureBytes);

// --- Frame times of a bounded number of runs

inline constexpr std::size_t maximumRunsWithFrameTimes = 64;
inline constexpr std::size_t maximumTracePoints = 400;
inline constexpr std::size_t minimumBins = 8, maximumBins = 40;  // of a histogram

/// Condenses all frames; the caller sets `label` and ids. Bins have equal width from the minimum to the maximum.
[[nodiscard]] FrameTimes condense(const std::vector<double>& frameMs);

/// Reads the first repetition of each cell, or of evenly spread cells if there are too many. Unreadable files are
/// reported in the data's problems.
void readFrameTimes(const std::filesystem::path& folder, ReportData& data);

}  // namespace dustbench::report
