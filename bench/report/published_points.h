// The numbers given in a paper's text, from `data/papers/<id>/published.csv`.
//
//     suite,axis,x,column,minimum,maximum,what
//
// One row per number: the suite of the chart, the axis and x on it (both empty: everywhere), the column of summary.csv,
// the range of values, and what was measured. A paper without the file has none; its charts can be compared by shape
// only.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// By suite. Throws InputError with file and line.
[[nodiscard]] std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper);

}  // namespace dustbench::bench
