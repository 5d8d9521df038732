// Condenses the frame times of a bounded number of runs for the page.
#pragma once

#include <filesystem>

#include "bench/report/report_data.h"

namespace dustbench::bench {

inline constexpr std::size_t maximumRunsWithFrameTimes = 64;
inline constexpr std::size_t maximumTracePoints = 400;
inline constexpr std::size_t minimumBins = 8, maximumBins = 40;  // of a histogram

/// Condenses all frames; the caller sets `label` and ids. Bins have equal width from the minimum to the maximum.
[[nodiscard]] FrameTimes condense(const std::vector<double>& frameMs);

/// Reads the first repetition of each cell, or of evenly spread cells if there are too many. Unreadable files are
/// reported in the data's problems.
void readFrameTimes(const std::filesystem::path& folder, ReportData& data);

}  // namespace dustbench::bench
