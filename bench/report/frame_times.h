// Frame times of a bounded number of runs, small enough for a page.
#pragma once

#include <filesystem>

#include "bench/report/report_data.h"

namespace dustbench::bench {

inline constexpr std::size_t maximumRunsWithFrameTimes = 64;
inline constexpr std::size_t maximumTracePoints = 400;
inline constexpr std::size_t minimumBins = 8, maximumBins = 40;  // of a histogram

/// Of all frames, `label` and ids left to the caller. Bins are equally wide from the minimum to the maximum.
[[nodiscard]] FrameTimes condense(const std::vector<double>& frameMs);

/// Of the first repetition of each cell, spread evenly over the cells where there are too many. What cannot be read
/// gives a sentence in the data's problems.
void readFrameTimes(const std::filesystem::path& folder, ReportData& data);

}  // namespace dustbench::bench
