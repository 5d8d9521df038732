// Writes one chart of the report to a file, with the page's specification but without a browser.
//
// Node runs Vega to produce SVG; rsvg-convert converts it to PNG and PDF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// Ids of the charts that `writeCharts` can write for this data: `carr2006-fig7`, `carr2006-fig7-stages` …, and of maps
/// of claims: `carr2006-by-voxel_edge`.
[[nodiscard]] std::vector<std::string> chartIds(const ReportData& data);

struct ChartTarget {
    std::filesystem::path folder;  ///< of the results; files are written to `charts` in it
    std::filesystem::path out;     ///< if not empty, instead of that: a file that ends in `.format`, or a folder
    std::string format;            ///< svg, png or pdf; empty: that of `out`, or svg
};

/// `id` may be a unique suffix of an id without `-quick` (`fig7`), or `all`: the chart of each suite except the
/// controls', and the maps of claims. Returns the files, ID.FORMAT. Throws InputError for an unknown id, and if node or
/// rsvg-convert is missing or fails.
std::vector<std::filesystem::path> writeCharts(const ReportData& data, const std::string& id,
                                               const ChartTarget& target);

/// Draws the chart with exactly this id into `file`, whose extension determines the format. Throws InputError as
/// writeCharts, and with `what` for another extension.
void drawChart(const ReportData& data, const std::string& id, const std::filesystem::path& file,
               const std::string& what);

}  // namespace dustbench::report
