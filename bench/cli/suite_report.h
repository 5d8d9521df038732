// The text output of `suite`, `reproduce` and `report --text`: tables of frame rates, stages and metrics, comparisons
// within a suite, and verdicts on a paper's claims.
#pragma once

#include <string>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/suite/cell_results.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_table.h"

namespace dustbench::cli {

[[nodiscard]] std::string suiteReport(const bench::Suite& suite, const bench::StoredRuns& runs);
[[nodiscard]] std::string runsReport(const std::string& title, const std::vector<bench::MeasuredCell>& cells);
/// Empty if the table has no rows.
[[nodiscard]] std::string publishedReport(bench::TextRows table);
[[nodiscard]] std::string claimsReport(const std::vector<bench::EvaluatedClaim>& claims);

}  // namespace dustbench::cli
