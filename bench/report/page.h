// The report as one HTML file that needs nothing else: no network, no second file.
#pragma once

#include <filesystem>
#include <string>

#include "bench/report/report_data.h"

namespace dustbench::bench {

[[nodiscard]] std::string pageOf(const ReportData& data);

/// Writes `folder`/index.html, and claims.csv where there are claims, and gives the page's path. Throws InputError
/// where that is a page of somebody else.
std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data);

}  // namespace dustbench::bench
