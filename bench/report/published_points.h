// The numbers stated in a paper's text, from `data/papers/<id>/published.csv`, each with its place on a chart.
//
//     suite,of,axis,x,column,unit,min,max,hardware,what
//
// One row per number: the suite of the chart, the series it belongs to (a selection, as in claims), the axis and x
// (both empty: the paper states no load), the column of summary.csv with its unit, the range of values, the hardware
// with its year, and a description. For a paper without the file, only the shapes of charts can be compared.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// By suite. Throws InputError with file, row, subject, given and allowed value for a row whose suite, chart, axis,
/// series or unit is unknown, that appears twice, or that contradicts numbers.csv.
[[nodiscard]] std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper);

/// The points whose series this group of runs contains, with the settings that are axes of the group.
[[nodiscard]] std::vector<PublishedPoint> publishedIn(const RunGroup& group, const std::vector<PublishedPoint>& points);

}  // namespace dustbench::report
