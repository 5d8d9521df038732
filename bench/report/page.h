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

/// Writes the page alone to `out`, a file that ends in `.html`, or index.html in a folder, which is made; its links
/// lead to `folder`. Returns its path.
std::filesystem::path writePageTo(const std::filesystem::path& out, const std::filesystem::path& folder,
                                  ReportData data);

}  // namespace dustbench::bench
