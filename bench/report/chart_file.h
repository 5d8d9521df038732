// One chart of the report as a file: by the page's own specification, without a browser.
//
// Node runs Vega and gives SVG; rsvg-convert makes PNG and PDF of it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// `carr2006-fig7`, `carr2006-fig7-stages` …: what `writeChart` knows for this data.
[[nodiscard]] std::vector<std::string> chartIds(const ReportData& data);

/// `format` is svg, png or pdf; `id` may be the end of an id that only one has, without its `-quick` (`fig7`). Gives
/// the file, `folder`/charts/ID.FORMAT. Throws InputError for an unknown id, and where node or rsvg-convert is missing
/// or fails.
std::filesystem::path writeChart(const std::filesystem::path& folder, const ReportData& data, const std::string& id,
                                 const std::string& format);

}  // namespace dustbench::bench
