// Suites on a console: what they are and will do, and their results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/claims/claim_ledger.h"
#include "bench/cli/plan_runner.h"
#include "bench/suite/suite.h"
#include "bench/suite/suite_cells.h"
#include "bench/suite/suite_table.h"

namespace dustbench::cli {

// --- Results, as `suite`, `reproduce` and `report --text` print them

/// Tables of frame rates, stages and metrics, comparisons within the suite, and its verdicts.
[[nodiscard]] std::string suiteReport(const suite::Suite& suite, const results::StoredRuns& runs);
[[nodiscard]] std::string runsReport(const std::string& title, const std::vector<suite::MeasuredCell>& cells);
/// Empty if the table has no rows.
[[nodiscard]] std::string publishedReport(suite::TextRows table);
[[nodiscard]] std::string claimsReport(const std::vector<claims::EvaluatedClaim>& claims);

// --- The suite itself: its runs and their state, its configurations, and an estimate of its duration

/// Prints every run with its state in the results folder `out`, which need not exist and is not changed: `done`,
/// `outdated`, `to do`, `damaged` and others. Returns the runs to do, which include damaged ones.
std::vector<suite::PlannedRun> printPlan(const std::vector<suite::PlannedRun>& plan, int repetitions,
                                         const std::filesystem::path& out);

/// Starts a run of each configuration in `toDo` and prints how long all runs will take. Returns an exit code. Throws
/// InputError if OpenGL is not available.
[[nodiscard]] int printEstimate(const std::vector<suite::PlannedRun>& toDo, PlanOptions options);

/// Describes one suite for `list suites ID`: file, varied parameters, full and quick run, comparisons.
[[nodiscard]] std::string describeSuite(const std::string& id);

}  // namespace dustbench::cli
