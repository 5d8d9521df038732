// The numbers that a paper's text gives, from `data/papers/<id>/published.csv`.
//
//     suite,axis,x,column,minimum,maximum,what
//
// One row a number: of which suite's chart, at which x of which axis (both empty: everywhere), in which column of
// summary.csv, between which values, and of what it was measured. A paper without the file gives none, and its charts
// can be compared in their shape only.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// By suite. Throws InputError with file and line.
[[nodiscard]] std::map<std::string, std::vector<PublishedPoint>> readPublished(const std::string& paper);

}  // namespace dustbench::bench
