// Writes one chart of the report as a file, using the page's specification, without a browser.
//
// Node runs Vega to produce SVG; rsvg-convert converts it to PNG and PDF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// `carr2006-fig7`, `carr2006-fig7-stages` …: the charts that `writeChart` offers for this data.
[[nodiscard]] std::vector<std::string> chartIds(const ReportData& data);

/// `format` is svg, png or pdf; `id` may be a unique suffix of an id, without its `-quick` (`fig7`). Returns the file,
/// `folder`/charts/ID.FORMAT. Throws InputError for an unknown id, and if node or rsvg-convert is missing or fails.
std::filesystem::path writeChart(const std::filesystem::path& folder, const ReportData& data, const std::string& id,
                                 const std::string& format);

/// Draws the chart with exactly this id into `file`, whose ending says the format. Throws InputError as writeChart, and
/// for another ending with `what`.
void drawChart(const ReportData& data, const std::string& id, const std::filesystem::path& file,
               const std::string& what);

}  // namespace dustbench::bench
