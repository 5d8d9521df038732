// Collects the pictures of a folder's runs, grouped by world and frame.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// Pictures are embedded unchanged or as JPEG, whichever is smaller, up to `maximumBytes` in total, beginning with the
/// moment of every group with the highest FLIP. The others are linked by their path in the folder. Unreadable files are
/// reported in the data's problems.
void collectPictures(const std::filesystem::path& folder, std::int64_t maximumBytes, ReportData& data);

/// `data:image/png;base64,…`
[[nodiscard]] std::string dataUrl(std::string_view mediaType, std::string_view bytes);

}  // namespace dustbench::report
