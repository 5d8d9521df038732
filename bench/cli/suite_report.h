// What `suite` and `reproduce` print of a suite: the table of FPS and stages, and the verdicts that it asks for.
#pragma once

#include <string>

#include "bench/suite/cell_results.h"
#include "bench/suite/suite.h"

namespace dustbench::cli {

[[nodiscard]] std::string suiteReport(const bench::Suite& suite, const bench::StoredRuns& runs);

}  // namespace dustbench::cli
