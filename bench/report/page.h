// Writes the report as one self-contained HTML file: no network, no second file.
#pragma once

#include <filesystem>
#include <string>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// `David N. Carr, Jim Geyer (2006): Variants of …`
[[nodiscard]] std::string citationOf(const Paper& paper);

[[nodiscard]] std::string pageOf(const ReportData& data);

/// Writes `folder`/index.html, and claims.csv if there are claims, and returns the page's path. Throws InputError if
/// there is already a page not written by this program.
std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data);

}  // namespace dustbench::bench
