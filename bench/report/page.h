// Writes the report as one self-contained HTML file, which needs no network and no other file.
#pragma once

#include <filesystem>
#include <string>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// `David N. Carr, Jim Geyer (2006): Variants of …`
[[nodiscard]] std::string citationOf(const Paper& paper);

[[nodiscard]] std::string pageOf(const ReportData& data);

/// Writes `folder`/index.html, and claims.csv if there are claims, and returns the page's path. Throws InputError if it
/// would replace a page that was not written by this program.
std::filesystem::path writePage(const std::filesystem::path& folder, const ReportData& data);

/// Writes only the page, to `out`, a file that ends in `.html`, or to index.html in a folder, which is created if
/// missing. Its links lead to `folder`. Returns its path.
std::filesystem::path writePageTo(const std::filesystem::path& out, const std::filesystem::path& folder,
                                  ReportData data);

}  // namespace dustbench::bench
