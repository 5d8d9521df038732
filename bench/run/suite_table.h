// A suite's results, one row a cell: medians over its repetitions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/run/run_record.h"
#include "bench/run/suite.h"

namespace dustbench::bench {

struct SuiteTable {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

/// What varies in the suite, then how many repetitions were done, median FPS with its spread over them, median frame
/// time and stages (ms). In the order of the suite's cells.
[[nodiscard]] SuiteTable tabulate(const Suite& suite, const std::map<std::string, StoredRun>& runs);

}  // namespace dustbench::bench
