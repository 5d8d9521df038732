// Writes one chart of the report as a file, using the page's specification, without a browser.
//
// Node runs Vega to produce SVG; rsvg-convert converts it to PNG and PDF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// `carr2006-fig7`, `carr2006-fig7-stages` …: the charts that `writeCharts` offers for this data.
[[nodiscard]] std::vector<std::string> chartIds(const ReportData& data);

struct ChartTarget {
    std::filesystem::path folder;  ///< of the results: the files go into `charts` in it
    std::filesystem::path out;     ///< instead: a file that ends in `.format`, or a folder; may be empty
    std::string format;            ///< svg, png or pdf; empty: that of `out`, or svg
};

/// `id` may be a unique suffix of an id, without its `-quick` (`fig7`), or `all`: that of each suite but the controls'.
/// Returns the files, ID.FORMAT. Throws InputError for an unknown id, and if node or rsvg-convert is missing or fails.
std::vector<std::filesystem::path> writeCharts(const ReportData& data, const std::string& id,
                                               const ChartTarget& target);

/// Draws the chart with exactly this id into `file`, whose ending says the format. Throws InputError as writeCharts,
/// and for another ending with `what`.
void drawChart(const ReportData& data, const std::string& id, const std::filesystem::path& file,
               const std::string& what);

}  // namespace dustbench::bench
